#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mesher::app {

/// A key with its modifiers, independent of any window library. `name` is the text printed on the
/// key, in lower case: "w", "1", "f12", "escape", "/".
struct KeyPress {
  std::string name;
  bool shift = false;
  bool control = false;
  friend bool operator==(const KeyPress&, const KeyPress&) = default;
};

/// Parses "w", "F12", "shift+d", "ctrl+shift+z", in any case; "esc" and "?" also work. None if a
/// modifier is unknown or the key is missing.
std::optional<KeyPress> parse_key(std::string_view text);

/// Parses a list of keys that are separated by spaces, as `--keys` takes it. Throws UsageError that
/// names the key that cannot be parsed.
std::vector<KeyPress> parse_keys(std::string_view text);

/// Returns the key as help shows it: "Ctrl+Shift+Z".
std::string to_text(const KeyPress& key);

}  // namespace mesher::app

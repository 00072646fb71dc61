#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mesher::app {

/// A key with its modifiers, independent of any window library. `name` is what is printed on the
/// key, in lower case: "w", "1", "f12", "escape", "/".
struct KeyPress {
  std::string name;
  bool shift = false;
  bool control = false;
  friend bool operator==(const KeyPress&, const KeyPress&) = default;
};

/// Reads "w", "F12", "shift+d", "ctrl+shift+z" (any case; "esc" and "?" work too). None where a
/// modifier is unknown or the key is missing.
std::optional<KeyPress> parse_key(std::string_view text);

/// Reads a list of keys between spaces, as `--keys` takes it. Throws UsageError that names the one
/// it cannot read.
std::vector<KeyPress> parse_keys(std::string_view text);

/// "Ctrl+Shift+Z": as help shows it.
std::string to_text(const KeyPress& key);

}  // namespace mesher::app

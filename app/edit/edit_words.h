#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/option_text.h"

namespace mesher::app {

/// An edit as text: "simplify_to faces=4500 cost=quadric". The journal and `mesher edit` use it.
/// The functions throw UsageError with the reason if the text does not fit.
class EditWords {
 public:
  /// Splits the text at blanks.
  explicit EditWords(std::string_view text);

  const std::string& name() const { return name_; }
  /// As it was given.
  const std::string& text() const { return text_; }
  bool has(const std::string& key) const { return values_.contains(key); }
  bool has_values() const { return !values_.empty(); }

  /// Takes a value out, if it is there.
  std::optional<std::string> take(const std::string& key);
  /// As above, a number. `otherwise`: if it is not there; none: it has to be there, and
  /// `expect_no_more` says so if it is not, because it may have been misspelled.
  std::uint32_t take_number(const std::string& key,
                            std::optional<std::uint32_t> otherwise = std::nullopt);
  /// As above, a number from `least` to `most`. It has to be there.
  float take_float(const std::string& key, float least, float most);
  /// Takes the options of a table that are there. The others keep their values.
  template <class S, std::size_t N>
  void take_options(const std::array<Option<S>, N>& table, S& options) {
    for (const Option<S>& option : table) {
      const std::optional<std::string> value = take(option.key);
      if (value && !set_option(option, options, *value)) refuse(option.key, *value);
    }
  }
  /// Refuses what was not taken, and lists what could have been; refuses if a number is missing.
  void expect_no_more() const;

  /// Throws: "simplify_to: 'x' is not a value of faces".
  [[noreturn]] void refuse(const std::string& key, const std::string& value) const;

 private:
  std::string text_;
  std::string name_;
  std::map<std::string, std::string> values_;
  std::vector<std::string> known_;  ///< keys that were asked for
  std::string missing_;             ///< the first that has to be there, and is not
};

}  // namespace mesher::app

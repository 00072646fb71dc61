#pragma once

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "engine/core/option.h"

namespace mesher {

/// Returns an option's value as text, such that `set_option` restores exactly this value:
/// "quadric", "on", "0.125".
template <class S>
std::string value_text(const Option<S>& option, const S& options) {
  const auto text = [&](const auto& member) -> std::string {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, EnumMember<S>>) {
      return member.text(member.get(options)).key;
    } else if constexpr (std::is_same_v<Member, bool S::*>) {
      return options.*member ? "on" : "off";
    } else {
      return fmt::format("{}", options.*member);
    }
  };
  return std::visit(text, option.member);
}

/// Sets an option to the value that `text` names. Returns false, and changes nothing, if `text` is
/// not a value of the option or is outside its range.
template <class S>
bool set_option(const Option<S>& option, S& options, std::string_view text) {
  const auto set = [&](const auto& member) -> bool {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, EnumMember<S>>) {
      for (std::size_t i = 0; i < member.count; ++i) {
        if (text != member.text(i).key) continue;
        member.set(options, i);
        return true;
      }
      return false;
    } else if constexpr (std::is_same_v<Member, bool S::*>) {
      if (text != "on" && text != "off") return false;
      options.*member = text == "on";
      return true;
    } else {
      std::decay_t<decltype(options.*member)> value{};
      const char* end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, value);
      const auto number = static_cast<double>(value);
      // Written so that NaN is refused.
      const bool is_in_range = number >= option.least && number <= option.most;
      if (error != std::errc() || stop != end || !is_in_range) return false;
      options.*member = value;
      return true;
    }
  };
  return std::visit(set, option.member);
}

/// Appends all options of a table as words: " cost=quadric seed=1".
template <class S, std::size_t N>
void append_options(std::string& words, const std::array<Option<S>, N>& table, const S& options) {
  for (const Option<S>& option : table)
    words += fmt::format(" {}={}", option.key, value_text(option, options));
}

}  // namespace mesher

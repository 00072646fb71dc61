#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/core/option.h"

namespace mesher::app {

/// A CLI11 check: a number from `least` to `most`. (CLI::Range accepts NaN.)
inline CLI::Validator number_between(double least, double most) {
  std::string range = CLI::detail::to_string(least) + " to " + CLI::detail::to_string(most);
  if (std::isinf(most)) range = CLI::detail::to_string(least) + " or more";
  return {[least, most, range](const std::string& text) -> std::string {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool is_number = !text.empty() && *end == '\0';
            if (is_number && value >= least && value <= most) return "";
            return "'" + text + "' is not a number from " + range;
          },
          range};
}

/// A CLI11 check: an integer from `least` to `most`. (CLI11 clamps larger ones silently.)
inline CLI::Validator integer_between(std::uint64_t least, std::uint64_t most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return {[least, most, range](const std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            const bool is_number = error == std::errc() && stop == end;
            if (is_number && value >= least && value <= most) return "";
            return "'" + text + "' is not an integer from " + range;
          },
          range};
}

/// The help of an option: "which edge to collapse first (default: quadric)".
template <class S>
std::string help_text(const Option<S>& option) {
  std::string text = option.help;
  if (*option.unit != '\0') text += std::string(" [") + option.unit + "]";
  return text + " (default: " + default_text(option) + ")";
}

namespace detail {

template <class S>
CLI::Option* add_member(CLI::App& command, const Option<S>& option, S& target,
                        const EnumMember<S>& member) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < member.count; ++i) {
    words.emplace_back(member.text(i).key);
    if (member.text(i).alias != nullptr) words.emplace_back(member.text(i).alias);
  }
  const auto take = [&target, member](const std::string& word) {
    for (std::size_t i = 0; i < member.count; ++i) {
      const ChoiceText& text = member.text(i);
      if (word == text.key || (text.alias != nullptr && word == text.alias)) member.set(target, i);
    }
  };
  return command
      .add_option_function<std::string>(std::string("--") + option.key, take, help_text(option))
      ->check(CLI::IsMember(words));
}

template <class S>
CLI::Option* add_member(CLI::App& command, const Option<S>& option, S& target, bool S::*member) {
  return command.add_flag(std::string("--") + option.key, target.*member, option.help);
}

template <class S, class Number>
CLI::Option* add_member(CLI::App& command, const Option<S>& option, S& target, Number S::*member) {
  CLI::Option* made =
      command.add_option(std::string("--") + option.key, target.*member, help_text(option));
  if constexpr (std::is_integral_v<Number>) {
    constexpr auto kMost = std::uint64_t{std::numeric_limits<Number>::max()};
    const auto most =
        option.most < static_cast<double>(kMost) ? static_cast<std::uint64_t>(option.most) : kMost;
    return made->check(integer_between(static_cast<std::uint64_t>(option.least), most));
  } else {
    return made->check(number_between(option.least, option.most));
  }
}

}  // namespace detail

/// Adds an option of a table to a command, which stores it in `target`.
template <class S>
CLI::Option* add_option(CLI::App& command, const Option<S>& option, S& target) {
  return std::visit(
      [&](const auto& member) { return detail::add_member(command, option, target, member); },
      option.member);
}

/// Adds all options of a table.
template <class S, std::size_t N>
void add_options(CLI::App& command, const std::array<Option<S>, N>& table, S& target) {
  for (const Option<S>& option : table)
    add_option(command, option, target);
}

}  // namespace mesher::app

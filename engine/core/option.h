#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "engine/core/choice.h"
#include "engine/core/text.h"

namespace mesher {

/// A member of `S` whose type is some described enumeration. Values are indices into its table.
template <class S>
struct EnumMember {
  std::size_t count;
  const ChoiceText& (*text)(std::size_t index);
  std::size_t (*get)(const S& options);
  void (*set)(S& options, std::size_t index);
};

/// A value with a special meaning: "180: tagged creases only".
struct SpecialValue {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none
  const char* label = "";
};

/// A row of the table that describes an options struct: one of its members. The command line,
/// --help, JSON, panels with their tooltips, and docs/reference.md follow from these tables. The
/// default is the member's own. To add an option, add the member and its row.
template <class S>
struct Option {
  using Member =
      std::variant<bool S::*, float S::*, std::uint32_t S::*, std::uint64_t S::*, EnumMember<S>>;

  const char* key;    ///< "crease-angle": on the command line; JSON uses underscores
  const char* label;  ///< in panels
  const char* help;   ///< what it does, in one phrase without a period
  Member member;
  const char* unit = "";  ///< of a number: "deg", "%", "px", "s"
  double least = 0.0;     ///< a number's range
  double most = std::numeric_limits<double>::infinity();
  SpecialValue special{};
  /// Whether the option has an effect, given the other options; null: always.
  bool (*applies)(const S& options) = nullptr;
};

namespace detail {

template <class S, class T>
S class_of(T S::*);
template <class S, class T>
T type_of(T S::*);

}  // namespace detail

/// Returns the EnumMember for a pointer to a member.
template <auto kMember>
constexpr auto enum_member() {
  using S = decltype(detail::class_of(kMember));
  using Enum = decltype(detail::type_of(kMember));
  return EnumMember<S>{
      .count = choices(Enum{}).size(),
      .text = [](std::size_t index) -> const ChoiceText& { return choices(Enum{})[index].text; },
      .get = [](const S& options) { return static_cast<std::size_t>(options.*kMember); },
      .set = [](S& options, std::size_t index) { options.*kMember = static_cast<Enum>(index); }};
}

/// Returns the option's key in JSON: underscores, and a suffix for an angle, a percentage or a
/// length on the screen ("crease_angle_deg").
template <class S>
std::string json_key(const Option<S>& option) {
  std::string key = option.key;
  for (char& c : key)
    c = c == '-' ? '_' : c;
  const std::string_view unit = option.unit;
  if (unit == "deg") key += "_deg";
  if (unit == "%") key += "_percent";
  if (unit == "px") key += "_px";
  return key;
}

/// Returns the default of an option as --help and the documentation show it: "quadric", "off",
/// "180".
template <class S>
std::string default_text(const Option<S>& option) {
  const S defaults{};
  const auto text = [&](const auto& member) -> std::string {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, EnumMember<S>>) {
      return member.text(member.get(defaults)).key;
    } else if constexpr (std::is_same_v<Member, bool S::*>) {
      return defaults.*member ? "on" : "off";
    } else {
      const auto value = static_cast<double>(defaults.*member);
      if (value != option.special.value) return number_text(value);
      return number_text(value) + ": " + option.special.label;
    }
  };
  return std::visit(text, option.member);
}

/// Returns the row with this key. Pre: the table has one.
template <class S, std::size_t N>
constexpr const Option<S>& option_named(const std::array<Option<S>, N>& table,
                                        std::string_view key) {
  std::size_t i = 0;
  while (i < N && key != table[i].key)
    ++i;
  return table.at(i);
}

}  // namespace mesher

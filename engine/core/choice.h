#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace mesher {

/// The words for one value of an enumeration.
struct ChoiceText {
  const char* key;              ///< on the command line and in JSON: "accumulated"
  const char* label;            ///< in panels and messages: "accumulated quadric"
  const char* help = "";        ///< what the value does, in a sentence or two
  const char* alias = nullptr;  ///< another key that the command line takes
};

/// A row of the table that describes an enumeration. Each described enumeration has one table and a
/// function `choices(Enum)` beside it that returns the table. The command line, JSON, panels and
/// documentation take their words from it.
template <class Enum>
struct Choice {
  Enum value;
  ChoiceText text;
};

template <class Enum, std::size_t N>
using Choices = std::array<Choice<Enum>, N>;

/// Returns whether an enumerator has this value. The compiler prints any other value as a cast.
template <auto kValue>
consteval bool is_enumerator() {
  constexpr std::string_view kParameter = "kValue = ";
  const std::string_view name = __PRETTY_FUNCTION__;
  return name[name.rfind(kParameter) + kParameter.size()] != '(';
}

/// Returns whether a table has one row per enumerator, in their order. Assert it beside the table,
/// so that a missing row does not compile. Pre: the enumerators have the values 0, 1, 2 and so on.
template <class Enum, std::size_t N>
consteval bool is_complete(const Choices<Enum, N>& table) {
  if (is_enumerator<static_cast<Enum>(N)>()) return false;
  for (std::size_t i = 0; i < N; ++i) {
    if (static_cast<std::size_t>(table[i].value) != i || table[i].text.key == nullptr) return false;
  }
  return true;
}

template <class Enum>
concept Described = requires(Enum value) {
  choices(value);
};

/// Returns the words for a value.
template <Described Enum>
constexpr const ChoiceText& text_of(Enum value) {
  return choices(value)[static_cast<std::size_t>(value)].text;
}

/// Returns the value's word on the command line and in JSON.
template <Described Enum>
constexpr std::string_view key(Enum value) {
  return text_of(value).key;
}

/// Returns the value's words in messages.
template <Described Enum>
constexpr std::string_view describe(Enum value) {
  return text_of(value).label;
}

/// Returns the value whose key or alias is `word`, or nothing if there is none.
template <Described Enum>
constexpr std::optional<Enum> parse_choice(std::string_view word) {
  for (const Choice<Enum>& choice : choices(Enum{})) {
    if (word == choice.text.key) return choice.value;
    if (choice.text.alias != nullptr && word == choice.text.alias) return choice.value;
  }
  return std::nullopt;
}

}  // namespace mesher

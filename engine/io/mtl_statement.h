#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace mesher::io {

/// A line of an MTL file, without the blanks around it.
struct MtlStatement {
  std::string keyword;  ///< in lower case; programs differ
  std::string_view rest;
};
MtlStatement split_mtl(std::string_view line);

/// Removes and returns the first word of a text; empty at its end or at a comment.
std::string_view next_word(std::string_view& text);

/// Returns the numbers of a statement up to a comment, or nothing if one of the words is none.
/// Missing numbers repeat the first one, as the format defines. Further words are ignored.
std::optional<float> mtl_number(std::string_view rest);
std::optional<glm::vec3> mtl_color(std::string_view rest);

/// A statement that names an image. Coordinates count v from the bottom, as in OBJ:
/// the image shows `scale` * uv + `offset`.
struct MtlMap {
  std::string_view file;  ///< a part of the line, without quotation marks; empty: it names none
  glm::vec2 offset{0.0F};
  glm::vec2 scale{1.0F};
  float strength = 1.0F;      ///< of a bump or normal map
  bool clamps = false;        ///< rather than to repeat the image
  char channel = '\0';        ///< of a map of one number: 'r', 'g', 'b', 'm', 'l', 'z'
  bool has_others = false;    ///< options without a counterpart in struct Texture
  bool is_malformed = false;  ///< an option lacks its value
};

/// Returns whether statements with this keyword name an image.
bool is_mtl_map(std::string_view keyword);
/// Reads such a statement.
MtlMap parse_mtl_map(const MtlStatement& statement);

}  // namespace mesher::io

#include "engine/io/mtl_write.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <unordered_map>

#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/image_placer.h"
#include "engine/io/mapped_file.h"
#include "engine/io/mtl_look.h"

namespace mesher::io {
namespace {

constexpr std::string_view kMtlHeader = "# mesher: materials\n";

/// Returns a name that a line can hold. Other bytes stay as they are, so that a name that is not
/// UTF-8 is still the same in another program.
std::string one_line_name(std::string_view name) {
  std::string line(name.substr(0, kMaxNameBytes));
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' '; }, '_');
  return line;
}

/// Returns names that lines of OBJ and MTL can hold, and no two alike.
std::vector<std::string> material_names(const Materials& materials) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Material& material : materials.materials) {
    std::string wanted = one_line_name(material.name);
    const std::size_t end = wanted.find_last_not_of(' ');
    wanted.resize(end == std::string::npos ? 0 : end + 1);
    wanted.erase(0, wanted.find_first_not_of(' '));
    if (wanted.empty()) wanted = "material";
    std::string name = wanted;
    constexpr std::size_t kRoom = 10;
    for (int number = 2; !taken.insert(name).second; ++number)
      name = wanted.substr(0, kMaxNameBytes - kRoom) + "-" + std::to_string(number);
    names.push_back(std::move(name));
  }
  return names;
}

class MtlWriter {
 public:
  MtlWriter(AtomicFile& obj, const Materials& materials)
      : materials_(materials), placer_(obj, materials) {
    for (std::size_t i = 0; i < materials.images.size(); ++i)
      by_path_.emplace(materials.images[i].path.string(), static_cast<std::uint32_t>(i));
  }

  std::string text(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Material& material = materials_.materials[i];
      if (material.is_name_only) continue;
      text += "\nnewmtl " + names[i] + "\n";
      for (const std::string& line :
           material.mtl_statements ? *material.mtl_statements : translated(material)) {
        text += (material.mtl_statements ? with_place(line, names[i]) : line) + "\n";
      }
    }
    return text.empty() ? text : std::string(kMtlHeader) + text;
  }

 private:
  std::vector<std::string> translated(const Material& material) {
    std::vector<std::string> files(materials_.images.size());
    const auto place = [&](const Texture& texture, const char* purpose) {
      if (fits_mtl(texture))
        files[texture.image] = placer_.place(texture.image, material.name + purpose);
    };
    place(material.base_color_texture, "-color");
    place(material.emission_texture, "-emission");
    place(material.metallic_roughness_texture, "-surface");
    place(material.normal_texture, "-normal");
    return mtl_statements(material, files);
  }

  /// Returns a statement with the path of its image as it is in the output.
  std::string with_place(const std::string& line, const std::string& material) {
    const MtlStatement statement = split_mtl(line);
    if (!is_mtl_map(statement.keyword)) return line;
    const std::string_view file = parse_mtl_map(statement).file;
    const auto image = by_path_.find(std::string(file));
    if (file.empty() || image == by_path_.end()) return line;
    const std::size_t at = static_cast<std::size_t>(file.data() - line.data());
    return line.substr(0, at) + placer_.place(image->second, material) +
           line.substr(at + file.size());
  }

  const Materials& materials_;
  ImagePlacer placer_;
  std::unordered_map<std::string, std::uint32_t> by_path_;
};

/// Returns whether a file may be replaced without asking.
bool is_ours(const std::filesystem::path& file, const std::string& text) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  try {
    const MappedFile old(file);
    return old.bytes().starts_with(kMtlHeader) || old.bytes() == text;
  } catch (const InputError&) {
    return false;
  }
}

std::string library_name(const AtomicFile& obj, const Materials& materials,
                         const std::string& text) {
  const std::filesystem::path target(obj.name());
  const std::string stem = target.stem().string();
  std::error_code error;
  const bool replaces = std::filesystem::exists(target, error);
  std::string name = stem + ".mtl";
  const auto is_usable = [&] {
    if (std::ranges::find(materials.missing_files, name) != materials.missing_files.end())
      return false;
    const std::filesystem::path file = target.parent_path() / name;
    return replaces || !std::filesystem::exists(file, error) || is_ours(file, text);
  };
  for (int number = 2; !is_usable(); ++number)
    name = stem + "-" + std::to_string(number) + ".mtl";
  return name;
}

}  // namespace

MtlReference add_mtl(AtomicFile& obj, const Materials& materials) {
  MtlReference reference{.libraries = materials.missing_files, .names = material_names(materials)};
  const std::string text = MtlWriter(obj, materials).text(reference.names);
  if (text.empty()) return reference;
  const std::string name = library_name(obj, materials, text);
  obj.add_side(name).write(text);
  reference.libraries.insert(reference.libraries.begin(), name);
  return reference;
}

}  // namespace mesher::io

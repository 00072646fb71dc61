#include "engine/io/obj_materials.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/beside.h"
#include "engine/io/image_files.h"
#include "engine/io/mtl_read.h"

namespace mesher::io {
namespace {

bool ends_in_mtl(std::string_view word) {
  constexpr std::string_view kEnd = ".mtl";
  return word.size() >= kEnd.size() &&
         std::ranges::equal(word.substr(word.size() - kEnd.size()), kEnd, [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

class ObjMaterials {
 public:
  ObjMaterials(const MappedFile& obj, Soup& soup)
      : folder_(std::filesystem::path(obj.name()).parent_path()),
        soup_(soup),
        reader_(materials_, soup.contents) {}

  void run(const ObjGroups& groups) {
    for (const std::string_view text : groups.libraries())
      add_libraries(text);
    load_images();
    name_groups(groups.materials());
    for (const Material& material : materials_.materials)
      soup_.contents.add(Content::materials, material.name);
    const bool is_any = !materials_.materials.empty() || !materials_.missing_files.empty();
    if (is_any) soup_.materials = std::make_shared<const Materials>(std::move(materials_));
  }

 private:
  /// The whole text may be one name with blanks.
  void add_libraries(std::string_view text) {
    if (!find_named_beside(folder_, text).file.empty()) return add_library(std::string(text));
    for (const std::string& name : mtl_file_names(text))
      add_library(name);
  }

  void add_library(const std::string& name) {
    if (std::ranges::find(files_, name) != files_.end()) return;
    if (files_.size() == kMostMtlFiles) return;
    files_.push_back(name);
    soup_.contents.add(Content::material_files, name);
    const Beside found = find_named_beside(folder_, name);
    if (found.file.empty()) {
      materials_.missing_files.push_back(name);
      soup_.contents.warn("material file " + name + ": " + std::string(found.reason()));
      return;
    }
    std::optional<MappedFile> file;
    try {
      file.emplace(found.file);
      reader_.read(*file);
    } catch (const InputChanged&) {
      throw;
    } catch (const InputError& error) {
      materials_.missing_files.push_back(name);
      soup_.contents.warn("material file " + name + ": " + error.reason());
    }
    if (file) file->check_unchanged();
  }

  void load_images() {
    ImageFiles files(soup_.contents);
    for (EncodedImage& image : materials_.images) {
      const std::string text = image.path.string();
      files.load(image, find_named_beside(folder_, text), text);
      soup_.contents.add(Content::textures, text);
    }
    materials_.texture_count = static_cast<std::uint32_t>(materials_.images.size());
  }

  /// Of materials with one name, the first counts.
  void name_groups(const std::vector<std::string_view>& names) {
    std::unordered_map<std::string, std::uint32_t> by_name;
    for (std::size_t i = 0; i < materials_.materials.size(); ++i)
      by_name.try_emplace(materials_.materials[i].name, static_cast<std::uint32_t>(i));
    std::vector<std::uint32_t> index;
    for (const std::string_view name : names) {
      const auto next = static_cast<std::uint32_t>(materials_.materials.size());
      const auto [entry, is_new] = by_name.try_emplace(std::string(name), next);
      if (is_new) {
        materials_.materials.push_back(
            {.name = std::string(name), .metallic = 0.0F, .is_name_only = true});
      }
      index.push_back(entry->second);
    }
    for (FaceGroup& group : soup_.attributes.groups) {
      if (group.material != kNone) group.material = index[group.material];
    }
  }

  std::filesystem::path folder_;
  Soup& soup_;
  Materials materials_;
  MtlReader reader_;
  std::vector<std::string> files_;
};

}  // namespace

std::vector<std::string> mtl_file_names(std::string_view text) {
  std::vector<std::string> names;
  std::string name;
  while (!text.empty()) {
    if (name.empty() && text.starts_with('"')) {
      const std::size_t end = std::min(text.find('"', 1), text.size());
      names.emplace_back(text.substr(1, end - 1));
      text.remove_prefix(std::min(end + 1, text.size()));
      continue;
    }
    const bool is_blank = text.front() == ' ' || text.front() == '\t';
    if (is_blank && (name.empty() || ends_in_mtl(name))) {
      if (!name.empty()) names.push_back(std::exchange(name, {}));
    } else {
      name += text.front();
    }
    text.remove_prefix(1);
  }
  if (!name.empty()) names.push_back(name);
  std::erase(names, "");
  return names;
}

void add_materials(const MappedFile& obj, const ObjGroups& groups, Soup& soup) {
  ObjMaterials(obj, soup).run(groups);
}

}  // namespace mesher::io

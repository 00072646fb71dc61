#include "engine/io/pm_materials.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/core/error.h"
#include "engine/io/gltf_container.h"
#include "engine/io/gltf_file.h"
#include "engine/io/gltf_material_write.h"
#include "engine/io/gltf_materials.h"
#include "engine/io/mapped_file.h"
#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

using MaterialsJson = nlohmann::ordered_json;

/// Takes the place of a file that is written.
class TextFile {
 public:
  void write(std::string_view text) { text_ += text; }
  std::string name() const { return "materials"; }
  std::string& text() { return text_; }

 private:
  std::string text_;
};

}  // namespace

std::string encode_pm_materials(const Materials* materials) {
  if (materials == nullptr || materials->materials.empty()) return {};
  MaterialsJson document{{"asset", {{"version", "2.0"}, {"generator", "mesher"}}}};
  std::string data;
  const auto add_bytes = [&](const std::string& bytes) {
    MaterialsJson& views = document["bufferViews"];
    views.push_back({{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", bytes.size()}});
    data += bytes;
    data.resize((data.size() + 3) / 4 * 4, '\0');
    return views.size() - 1;
  };
  add_gltf_materials(document, *materials, kNone, add_bytes);
  GltfParts parts;
  parts.document = document.dump(-1, ' ', false, MaterialsJson::error_handler_t::replace);
  if (!data.empty()) parts.buffers.push_back(MaterialsJson{{"byteLength", data.size()}}.dump());
  parts.bytes = data.size();
  TextFile file;
  write_container(file, parts, true, [&](auto& sink) { sink.write(data); });
  return std::move(file.text());
}

std::shared_ptr<const Materials> decode_pm_materials(std::span<const std::byte> bytes,
                                                     const std::filesystem::path& file,
                                                     FileContents& contents) {
  if (bytes.empty()) return nullptr;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    const MappedFile document(file.string(), text);
    GltfFile gltf(document, nullptr);
    std::shared_ptr<const Materials> materials = read_gltf_materials(gltf, contents);
    if (materials == nullptr) return nullptr;
    for (const Material& material : materials->materials)
      contents.add(Content::materials, material.name);
    contents[Content::textures] = materials->texture_count;
    return materials;
  } catch (const InputChanged&) {
    throw;
  } catch (const InputError& error) {
    // The shape of a file does not suffer from its look.
    contents.warn("materials: " + error.reason());
    return nullptr;
  }
}

}  // namespace mesher::io

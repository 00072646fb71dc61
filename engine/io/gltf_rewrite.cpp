#include "engine/io/gltf_rewrite.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base64.h"
#include "engine/io/beside.h"
#include "engine/io/gltf_container.h"
#include "engine/io/gltf_mesh.h"
#include "engine/io/gltf_types.h"
#include "engine/io/image_files.h"
#include "engine/mesh/contents.h"

namespace mesher::io {
namespace {

using Json = nlohmann::json;

constexpr int kVertexTarget = 34962;
constexpr int kIndexTarget = 34963;
constexpr const char* kDraco = "KHR_draco_mesh_compression";
/// Extensions of a primitive that hold for whatever triangles it has.
constexpr const char* kVariants = "KHR_materials_variants";

std::string to_base64(std::string_view bytes) {
  struct Text {
    std::string text;
    void write(std::string_view more) { text += more; }
  } sink;
  Base64Writer<Text> writer(sink);
  writer.write(bytes);
  writer.finish();
  return std::move(sink.text);
}

/// Returns whether a buffer has no data: it stands for the decoded bytes of compressed views.
bool is_virtual(const Json& buffer) {
  if (!buffer.is_object() || buffer.contains("uri") || !buffer.contains("extensions")) return false;
  const Json& extensions = buffer["extensions"];
  return extensions.is_object() && extensions.contains(kMeshoptExtension) &&
         extensions[kMeshoptExtension].is_object() &&
         extensions[kMeshoptExtension].contains("fallback") &&
         extensions[kMeshoptExtension]["fallback"] == true;
}

/// Returns the elements of a list that are true in `all` and not in `kept`, the last one first.
std::vector<std::size_t> difference_of(const std::vector<bool>& all,
                                       const std::vector<bool>& kept) {
  std::vector<std::size_t> list;
  for (std::size_t i = all.size(); i-- > 0;) {
    if (all[i] && !kept[i]) list.push_back(i);
  }
  return list;
}

/// What users call an attribute, or a layer of a morph target.
const char* attribute_words(std::string_view name) {
  switch (attribute_kind(name)) {
    case AttributeKind::texcoord:
      return "texture coordinates";
    case AttributeKind::normal:
      return "normals";
    case AttributeKind::tangent:
      return "tangents";
    case AttributeKind::color:
      return "colors";
    case AttributeKind::joints:
    case AttributeKind::weights:
      return "joints and weights";
    case AttributeKind::delta:
    case AttributeKind::custom:
      break;
  }
  return name.starts_with("target ") ? "part of a morph target" : "own property";
}

void remove_names(Json& document, const char* list, const std::function<bool(const Json&)>& is) {
  const auto found = document.find(list);
  if (found == document.end() || !found->is_array()) return;
  Json left = Json::array();
  for (Json& name : *found) {
    if (!is(name)) left.push_back(std::move(name));
  }
  if (left.empty()) {
    document.erase(list);
  } else {
    *found = std::move(left);
  }
}

Json copy_of(const GltfFile& gltf) {
  check_depth(gltf);
  return gltf.root();
}

}  // namespace

std::size_t GltfRewriter::Slots::take(Json& array) {
  if (free.empty()) {
    array.push_back(Json::object());
    return array.size() - 1;
  }
  const std::size_t slot = free.back();
  free.pop_back();
  array[slot] = Json::object();
  return slot;
}

GltfRewriter::GltfRewriter(GltfFile& gltf, std::span<const GltfMeshEdit> edits, bool compresses,
                           Progress* progress)
    : gltf_(gltf), progress_(progress), document_(copy_of(gltf)), compresses_(compresses) {
  const GltfFile::Reports reports(gltf, progress);
  try {
    plan(edits);
  } catch (const Json::exception&) {
    gltf.fail("a member of the document has the wrong type");
  }
}

void GltfRewriter::plan(std::span<const GltfMeshEdit> edits) {
  find_free_slots(edits);
  keep_data();
  embed_images();
  find_nodes_of_meshes();
  bool has_levels = false;
  for (const GltfMeshEdit& edit : edits) {
    check_cancelled(progress_);
    if (edit.replaces) replace(edit);
    if (edit.levels.size() < 2) continue;
    add_levels(edit);
    has_levels = true;
  }
  clear_free_slots();
  document_.erase("buffers");  // write() adds those of the new file
  data_.arrange();
  set_offsets();
  set_extension_lists(has_levels);
}

void GltfRewriter::find_free_slots(std::span<const GltfMeshEdit> edits) {
  std::map<std::size_t, std::set<std::size_t>> replaced;
  for (const GltfMeshEdit& edit : edits) {
    if (!edit.replaces) continue;
    for (const FaceGroup& group : edit.levels.front().attributes->groups)
      replaced[edit.mesh].insert(group.primitive);
  }
  const GltfUses all = find_uses(gltf_, [](std::size_t, std::size_t) { return false; });
  const GltfUses kept = find_uses(gltf_, [&](std::size_t mesh, std::size_t primitive) {
    const auto found = replaced.find(mesh);
    return found != replaced.end() && found->second.contains(primitive);
  });
  accessors_.free = difference_of(all.accessors, kept.accessors);
  views_.free = difference_of(all.views, kept.views);
}

void GltfRewriter::keep_data() {
  is_new_view_.resize(gltf_.count("bufferViews"), false);
  for (const std::size_t view : views_.free)
    is_new_view_[view] = true;
  find_virtual_buffers();
  for (std::size_t i = 0; i < is_new_view_.size(); ++i) {
    if (is_new_view_[i]) continue;
    const Json& view = gltf_.element("bufferViews", i);
    keep_range(view);
    if (const Json* packed = gltf_.extension(view, kMeshoptExtension)) keep_range(*packed);
  }
}

/// Finds the buffers without data that views still refer to.
void GltfRewriter::find_virtual_buffers() {
  std::set<std::uint64_t> used;
  for (std::size_t i = 0; i < is_new_view_.size(); ++i) {
    if (!is_new_view_[i])
      used.insert(gltf_.find_number(gltf_.element("bufferViews", i), "buffer").value_or(0));
  }
  for (const std::uint64_t buffer : used) {
    if (is_virtual(gltf_.element("buffers", buffer))) virtual_buffers_.push_back(buffer);
  }
}

void GltfRewriter::keep_range(const Json& range) {
  const auto buffer = gltf_.find_number(range, "buffer").value_or(~std::uint64_t{0});
  if (std::ranges::count(virtual_buffers_, buffer) > 0) return;
  data_.keep(buffer, gltf_.find_number(range, "byteOffset").value_or(0), gltf_.range_of(range));
}

void GltfRewriter::embed_images() {
  const auto images = document_.find("images");
  if (images == document_.end() || !images->is_array()) return;
  std::map<std::string, Json> known;  // images often share a file
  for (Json& image : *images) {
    check_cancelled(progress_);
    if (!image.is_object() || !image.contains("uri") || !image["uri"].is_string()) continue;
    const auto uri = image["uri"].get<std::string>();
    const auto earlier = known.find(uri);
    if (earlier == known.end()) {
      embed(image);
      known.emplace(uri, image);
      continue;
    }
    if (!earlier->second.contains("bufferView")) {
      image["uri"] = earlier->second["uri"];
      continue;
    }
    image.erase("uri");
    image["bufferView"] = earlier->second["bufferView"];
    image["mimeType"] = earlier->second["mimeType"];
  }
}

void GltfRewriter::embed(Json& image) {
  const auto uri = image["uri"].get<std::string>();
  std::string bytes;
  try {
    bytes = gltf_.resource(uri);
  } catch (const InputChanged&) {
    throw;
  } catch (const InputError&) {
    FileContents readable;  // escapes control characters and truncates
    readable.add(Content::textures, uri);
    const Beside found = find_uri_beside(gltf_.folder(), uri);
    losses_.push_back(
        fmt::format("the image of {} ({})", readable.phrase(Content::textures),
                    found.is_address ? found.reason() : "it is missing or outside the folder"));
    return;
  }
  const std::string_view type = image_type(bytes);
  if (!image.contains("mimeType") && type.empty()) {
    losses_.push_back("an image of a kind that cannot be embedded");
    return;
  }
  // A buffer view needs a type, and core textures may only have these two. Files that break that
  // rule without saying so stay as they are.
  const bool is_core = type == "image/png" || type == "image/jpeg";
  if (!image.contains("mimeType") && !is_core) {
    image["uri"] = fmt::format("data:{};base64,{}", type, to_base64(bytes));
    return;
  }
  if (!image.contains("mimeType")) image["mimeType"] = type;
  image.erase("uri");
  image["bufferView"] = add_view(std::move(bytes));
}

std::size_t GltfRewriter::add_view(std::string&& bytes) {
  const std::size_t view = views_.take(document_["bufferViews"]);
  is_new_view_.resize(document_["bufferViews"].size(), true);
  view_pieces_.emplace_back(view, data_.add(std::move(bytes)));
  return view;
}

void GltfRewriter::replace(const GltfMeshEdit& edit) {
  Json& primitives = document_["meshes"][edit.mesh]["primitives"];
  note_missing(edit.mesh, set_primitives(primitives, edit.levels.front()));
}

std::vector<std::string> GltfRewriter::set_primitives(Json& primitives, const GltfLevel& level) {
  GltfPrimitiveMaker maker(level);
  std::vector<std::string> missing;
  for (std::size_t p = primitives.size(); p-- > 0;) {
    if (!maker.makes(p)) continue;
    GltfPrimitiveArrays arrays = maker.make(p, primitives[p]);
    if (arrays.attributes.empty()) {
      primitives.erase(p);
      continue;
    }
    missing.insert(missing.end(), arrays.missing.begin(), arrays.missing.end());
    set_primitive(primitives[p], std::move(arrays));
  }
  return missing;
}

void GltfRewriter::set_primitive(Json& primitive, GltfPrimitiveArrays&& arrays) {
  const Json original = primitive;
  const auto old = [](const Json& object, const std::string& key) -> std::optional<std::uint64_t> {
    if (!object.contains(key) || !object[key].is_number_unsigned()) return std::nullopt;
    return object[key].get<std::uint64_t>();
  };
  primitive.erase("mode");
  primitive["attributes"] = Json::object();
  for (GltfArray& array : arrays.attributes) {
    const std::string name = array.name;
    primitive["attributes"][name] =
        add_array(std::move(array), old(original["attributes"], name), attribute_kind(name));
  }
  for (std::size_t t = 0; t < arrays.targets.size(); ++t) {
    primitive["targets"][t] = Json::object();
    for (GltfArray& array : arrays.targets[t]) {
      const std::string name = array.name;
      primitive["targets"][t][name] =
          add_array(std::move(array), old(original["targets"][t], name), AttributeKind::delta);
    }
  }
  primitive["indices"] =
      add_array(std::move(arrays.indices), old(original, "indices"), AttributeKind::custom, true);
  drop_extensions(primitive);
}

/// Adds an accessor with its own view. It keeps the name and extras of the one it replaces.
std::uint64_t GltfRewriter::add_array(GltfArray&& array, std::optional<std::uint64_t> old,
                                      AttributeKind kind, bool is_index) {
  std::size_t view = 0;
  if (compresses_) {
    view = add_compressed(is_index ? compress_indices(array) : compress(array, kind));
  } else {
    view = add_view(std::move(array.bytes));
    if (array.stride > 0) document_["bufferViews"][view]["byteStride"] = array.stride;
  }
  document_["bufferViews"][view]["target"] = is_index ? kIndexTarget : kVertexTarget;
  Json json = array.json;
  if (old && *old < gltf_.count("accessors")) {
    for (const char* key : {"name", "extras"}) {
      const Json& before = gltf_.element("accessors", *old);
      if (before.contains(key)) json[key] = before[key];
    }
  }
  json["bufferView"] = view;
  const std::size_t slot = accessors_.take(document_["accessors"]);
  document_["accessors"][slot] = std::move(json);
  return slot;
}

/// Adds a view whose decoded bytes lie in a buffer without data.
std::size_t GltfRewriter::add_compressed(CompressedArray&& array) {
  const std::size_t view = views_.take(document_["bufferViews"]);
  is_new_view_.resize(document_["bufferViews"].size(), true);
  document_["bufferViews"][view] = compressed_.add(array);
  view_pieces_.emplace_back(view, data_.add(std::move(array.bytes)));
  return view;
}

void GltfRewriter::drop_extensions(Json& primitive) {
  const auto found = primitive.find("extensions");
  if (found == primitive.end() || !found->is_object()) return;
  Json left = Json::object();
  for (const auto& [name, extension] : found->items()) {
    if (name == kVariants) {
      left[name] = extension;
    } else if (dropped_extensions_.insert(name).second && name != kDraco) {
      losses_.push_back("the extension " + name + " of edited meshes");
    }
  }
  if (left.empty()) {
    primitive.erase("extensions");
  } else {
    *found = std::move(left);
  }
}

/// What an edit left unused at the end of a list is removed; elsewhere, an empty element keeps the
/// indices of the others.
void GltfRewriter::clear_free_slots() {
  const auto clear = [](Json& array, std::vector<std::size_t>& free, const Json& empty) {
    for (const std::size_t slot : free) {
      if (slot + 1 == array.size()) {
        array.erase(slot);
      } else {
        array[slot] = empty;
      }
    }
  };
  clear(document_["accessors"], accessors_.free,
        {{"componentType", gltf_number(ComponentType::u8)}, {"count", 1}, {"type", "SCALAR"}});
  clear(document_["bufferViews"], views_.free,
        {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 1}});
  for (const char* list : {"accessors", "bufferViews"}) {
    if (document_[list].empty()) document_.erase(list);
  }
}

void GltfRewriter::set_offsets() {
  const auto number_of = [&](std::uint64_t buffer) -> std::optional<std::uint64_t> {
    const auto found = std::ranges::find(virtual_buffers_, buffer);
    if (found == virtual_buffers_.end()) return std::nullopt;
    return static_cast<std::uint64_t>(found - virtual_buffers_.begin()) + 1;
  };
  const auto move = [&](Json& range) {
    const auto buffer = range["buffer"].get<std::uint64_t>();
    if (const auto number = number_of(buffer)) {
      range["buffer"] = *number;
      return;
    }
    range["byteOffset"] = data_.offset(buffer, range.value("byteOffset", std::uint64_t{0}));
    range["buffer"] = 0;
  };
  for (std::size_t i = 0; i < gltf_.count("bufferViews"); ++i) {
    if (is_new_view_[i]) continue;
    Json& view = document_["bufferViews"][i];
    move(view);
    if (gltf_.extension(gltf_.element("bufferViews", i), kMeshoptExtension) != nullptr)
      move(view["extensions"][kMeshoptExtension]);
  }
  for (const auto& [view, piece] : view_pieces_) {
    Json& json = document_["bufferViews"][view];
    const bool is_compressed = json.contains("extensions");
    if (is_compressed) json["buffer"] = virtual_buffers_.size() + 1;
    Json& place = is_compressed ? json["extensions"][kMeshoptExtension] : json;
    place["buffer"] = 0;
    place["byteOffset"] = data_.piece_offset(piece);
    place["byteLength"] = data_.piece_bytes(piece);
  }
}

void GltfRewriter::set_extension_lists(bool has_levels) {
  dropped_extensions_.insert(kMeshoptExtension);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    remove_names(document_, list, [&](const Json& name) {
      return name.is_string() && dropped_extensions_.contains(name.get<std::string>()) &&
             !has_extension(document_, name.get<std::string>());
    });
  }
  const auto add = [&](const char* list, const char* name) {
    if (!std::ranges::count(document_[list], Json(name))) document_[list].push_back(name);
  };
  if (has_levels) add("extensionsUsed", "MSFT_lod");
  if (compressed_.is_empty()) return;
  for (const char* name : {kMeshoptExtension, kQuantizationExtension}) {
    add("extensionsUsed", name);
    add("extensionsRequired", name);
  }
}

void GltfRewriter::note_missing(std::uint64_t mesh, const std::vector<std::string>& names) {
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
    losses_.push_back(fmt::format("{} ({}) of mesh {}", attribute_words(name), name, mesh));
  }
}

void GltfRewriter::write(AtomicFile& file, bool binary, Progress* progress) const {
  GltfParts parts;
  parts.bytes = data_.size();
  if (parts.bytes > 0 || !virtual_buffers_.empty()) {
    Json first = gltf_.count("buffers") > 0 ? gltf_.element("buffers", 0) : Json::object();
    if (!virtual_buffers_.empty() && virtual_buffers_.front() == 0) first = Json::object();
    first.erase("uri");
    first["byteLength"] = parts.bytes;
    parts.buffers.push_back(first.dump());
    for (const std::uint64_t buffer : virtual_buffers_)
      parts.buffers.push_back(gltf_.element("buffers", buffer).dump());
    if (!compressed_.is_empty()) parts.buffers.push_back(compressed_.fallback().dump());
  }
  parts.document = document_.dump();
  try {
    write_container(file, parts, binary, [&](auto& sink) { data_.write(sink, progress); });
  } catch (const OutputError&) {
    gltf_.check_unchanged();  // the system cannot write pages of a file that was cut short
    throw;
  }
  gltf_.check_unchanged();  // what is copied was read just now
}

}  // namespace mesher::io

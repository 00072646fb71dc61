#include "engine/io/gltf_rewrite.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base64.h"
#include "engine/io/gltf_container.h"
#include "engine/io/gltf_types.h"
#include "engine/mesh/contents.h"

namespace mesher::io {
namespace {

using Json = nlohmann::json;

constexpr int kVertexTarget = 34962;
constexpr int kIndexTarget = 34963;
constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr const char* kMeshopt = "EXT_meshopt_compression";
/// Extensions of a primitive that hold for whatever triangles it has.
constexpr const char* kVariants = "KHR_materials_variants";

/// Returns the media type of an image by how its file begins; empty: not known.
std::string_view image_type(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
  if (bytes.starts_with("\xABKTX 20\xBB")) return "image/ktx2";
  if (bytes.starts_with("DDS ")) return "image/vnd-ms.dds";
  return {};
}

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
  return extensions.is_object() && extensions.contains(kMeshopt) &&
         extensions[kMeshopt].is_object() && extensions[kMeshopt].value("fallback", false);
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

std::vector<std::size_t> groups_by_primitive(const Attributes& attributes, std::size_t primitives) {
  std::vector<std::size_t> group(primitives, attributes.groups.size());
  for (std::size_t g = 0; g < attributes.groups.size(); ++g)
    group[attributes.groups[g].primitive] = g;
  return group;
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

GltfRewriter::GltfRewriter(GltfFile& gltf, std::span<const GltfMeshEdit> edits, Progress* progress)
    : gltf_(gltf), progress_(progress), document_(gltf.root()) {
  find_free_slots(edits);
  keep_data();
  embed_images();
  bool has_levels = false;
  for (const GltfMeshEdit& edit : edits) {
    check_cancelled(progress);
    if (edit.replaces) replace(edit);
    if (edit.levels.size() < 2) continue;
    add_levels(edit);
    has_levels = true;
  }
  clear_free_slots();
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
  for (std::uint64_t i = 0; i < gltf_.count("buffers"); ++i) {
    if (is_virtual(gltf_.element("buffers", i))) virtual_buffers_.push_back(i);
  }
  is_new_view_.resize(gltf_.count("bufferViews"), false);
  for (const std::size_t view : views_.free)
    is_new_view_[view] = true;
  for (std::size_t i = 0; i < is_new_view_.size(); ++i) {
    if (is_new_view_[i]) continue;
    const Json& view = gltf_.element("bufferViews", i);
    keep_range(view);
    if (const Json* packed = gltf_.extension(view, kMeshopt)) keep_range(*packed);
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
  } catch (const InputError&) {
    FileContents readable;  // replaces control characters and truncates
    readable.add(Content::textures, uri);
    losses_.push_back("the image of " + readable.phrase(Content::textures) +
                      " (it is missing or outside the folder)");
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
  const GltfLevel& level = edit.levels.front();
  Json& primitives = document_["meshes"][edit.mesh]["primitives"];
  const Json& originals = gltf_.element("meshes", edit.mesh)["primitives"];
  const auto groups = groups_by_primitive(*level.attributes, originals.size());
  GltfPrimitiveMaker maker(level);
  std::vector<std::string> missing;
  for (std::size_t p = originals.size(); p-- > 0;) {
    if (groups[p] == level.attributes->groups.size()) continue;
    const GltfPrimitiveArrays arrays =
        maker.make(static_cast<std::uint32_t>(groups[p]), originals[p]);
    if (arrays.attributes.empty()) {
      primitives.erase(p);
      continue;
    }
    set_primitive(primitives[p], arrays);
    missing.insert(missing.end(), arrays.missing.begin(), arrays.missing.end());
  }
  note_missing(edit.mesh, missing);
}

void GltfRewriter::set_primitive(Json& primitive, const GltfPrimitiveArrays& arrays) {
  const Json original = primitive;
  const auto old = [](const Json& object, const std::string& key) -> std::optional<std::uint64_t> {
    if (!object.contains(key) || !object[key].is_number_unsigned()) return std::nullopt;
    return object[key].get<std::uint64_t>();
  };
  primitive.erase("mode");
  primitive["attributes"] = Json::object();
  for (const GltfArray& array : arrays.attributes) {
    primitive["attributes"][array.name] =
        add_array(array, old(original["attributes"], array.name), kVertexTarget);
  }
  for (std::size_t t = 0; t < arrays.targets.size(); ++t) {
    primitive["targets"][t] = Json::object();
    for (const GltfArray& array : arrays.targets[t]) {
      primitive["targets"][t][array.name] =
          add_array(array, old(original["targets"][t], array.name), kVertexTarget);
    }
  }
  primitive["indices"] = add_array(arrays.indices, old(original, "indices"), kIndexTarget);
  drop_extensions(primitive);
}

/// Adds an accessor with its own view. It keeps the name and extras of the one it replaces.
std::uint64_t GltfRewriter::add_array(const GltfArray& array, std::optional<std::uint64_t> old,
                                      int target) {
  Json json = array.json;
  if (old && *old < gltf_.count("accessors")) {
    for (const char* key : {"name", "extras"}) {
      const Json& before = gltf_.element("accessors", *old);
      if (before.contains(key)) json[key] = before[key];
    }
  }
  const std::size_t view = add_view(std::string(array.bytes));
  json["bufferView"] = view;
  Json& view_json = document_["bufferViews"][view];
  view_json["target"] = target;
  if (array.stride > 0) view_json["byteStride"] = array.stride;
  const std::size_t slot = accessors_.take(document_["accessors"]);
  document_["accessors"][slot] = std::move(json);
  return slot;
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

/// Adds a mesh for each further level, and nodes that show it. A node with children shows its mesh
/// by a child of its own, because a level stands for the node with all below it.
void GltfRewriter::add_levels(const GltfMeshEdit& edit) {
  const Json original = gltf_.element("meshes", edit.mesh);
  std::vector<std::size_t> meshes;
  for (std::size_t i = 1; i < edit.levels.size(); ++i) {
    Json mesh = original;
    if (mesh.contains("name") && mesh["name"].is_string())
      mesh["name"] = mesh["name"].get<std::string>() + "_lod" + std::to_string(i);
    const auto groups =
        groups_by_primitive(*edit.levels[i].attributes, original["primitives"].size());
    GltfPrimitiveMaker maker(edit.levels[i]);
    for (std::size_t p = groups.size(); p-- > 0;) {
      if (groups[p] == edit.levels[i].attributes->groups.size()) continue;
      const auto arrays =
          maker.make(static_cast<std::uint32_t>(groups[p]), original["primitives"][p]);
      if (arrays.attributes.empty()) {
        mesh["primitives"].erase(p);
      } else {
        set_primitive(mesh["primitives"][p], arrays);
      }
    }
    document_["meshes"].push_back(std::move(mesh));
    meshes.push_back(document_["meshes"].size() - 1);
  }
  const std::size_t nodes = gltf_.count("nodes");
  for (std::size_t n = 0; n < nodes; ++n) {
    if (document_["nodes"][n].value("mesh", ~std::uint64_t{0}) != edit.mesh) continue;
    if (gltf_.extension(gltf_.element("nodes", n), "MSFT_lod") != nullptr) {
      losses_.emplace_back("new levels of a node that has levels already");
      continue;
    }
    add_node_levels(n, edit, meshes);
  }
}

void GltfRewriter::add_node_levels(std::size_t node, const GltfMeshEdit& edit,
                                   const std::vector<std::size_t>& meshes) {
  Json& nodes = document_["nodes"];
  Json shown = Json::object();  // what a node needs to show a mesh
  for (const char* key : {"mesh", "skin", "weights"}) {
    if (nodes[node].contains(key)) shown[key] = nodes[node][key];
  }
  constexpr const char* kInstances = "EXT_mesh_gpu_instancing";
  if (gltf_.extension(gltf_.element("nodes", node), kInstances) != nullptr)
    shown["extensions"][kInstances] = nodes[node]["extensions"][kInstances];
  std::size_t at = node;
  if (nodes[node].contains("children")) {
    nodes.push_back(shown);
    at = nodes.size() - 1;
    nodes[node]["children"].push_back(at);
    for (const char* key : {"mesh", "skin", "weights"})
      nodes[node].erase(key);
    if (shown.contains("extensions")) nodes[node]["extensions"].erase(kInstances);
  }
  Json coverage = Json::array({edit.levels.front().least_coverage});
  Json ids = Json::array();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    shown["mesh"] = meshes[i];
    if (nodes[node].contains("name") && nodes[node]["name"].is_string())
      shown["name"] = nodes[node]["name"].get<std::string>() + "_lod" + std::to_string(i + 1);
    // A level takes the place of the node, which may stand anywhere.
    if (at == node) {
      for (const char* key : {"matrix", "translation", "rotation", "scale"}) {
        if (nodes[node].contains(key)) shown[key] = nodes[node][key];
      }
    }
    nodes.push_back(shown);
    ids.push_back(nodes.size() - 1);
    coverage.push_back(edit.levels[i + 1].least_coverage);
  }
  nodes[at]["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
  if (!nodes[at].contains("extras") || nodes[at]["extras"].is_object())
    nodes[at]["extras"]["MSFT_screencoverage"] = std::move(coverage);
}

/// What an edit left unused at the end of a list is removed; elsewhere, an empty element keeps the
/// indices of the others.
void GltfRewriter::clear_free_slots() {
  const auto clear = [](Json& array, std::vector<std::size_t>& free, const Json& empty) {
    while (!free.empty() && free.front() + 1 == array.size()) {
      array.erase(free.front());
      free.erase(free.begin());
    }
    for (const std::size_t slot : free)
      array[slot] = empty;
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
    if (gltf_.extension(gltf_.element("bufferViews", i), kMeshopt) != nullptr)
      move(view["extensions"][kMeshopt]);
  }
  for (const auto& [view, piece] : view_pieces_) {
    Json& json = document_["bufferViews"][view];
    json["buffer"] = 0;
    json["byteOffset"] = data_.piece_offset(piece);
    json["byteLength"] = data_.piece_bytes(piece);
  }
}

void GltfRewriter::set_extension_lists(bool has_levels) {
  dropped_extensions_.insert(kMeshopt);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    remove_names(document_, list, [&](const Json& name) {
      return name.is_string() && dropped_extensions_.contains(name.get<std::string>()) &&
             !has_extension(document_, name.get<std::string>());
    });
  }
  if (has_levels && !std::ranges::count(document_["extensionsUsed"], Json("MSFT_lod")))
    document_["extensionsUsed"].push_back("MSFT_lod");
}

void GltfRewriter::note_missing(std::uint64_t mesh, const std::vector<std::string>& names) {
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
    losses_.push_back(fmt::format("{} of mesh {}", name, mesh));
  }
}

void GltfRewriter::write(AtomicFile& file, bool binary, Progress* progress) const {
  Json document = document_;
  document.erase("buffers");
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
  }
  parts.document = document.dump();
  write_container(file, parts, binary, [&](auto& sink) { data_.write(sink, progress); });
}

}  // namespace mesher::io

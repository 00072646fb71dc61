#include "engine/io/gltf_uses.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/io/gltf_contents.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

/// Copying and writing a document take stack for each level.
constexpr int kDeepest = 512;

/// Calls `visit(object, depth)` for a value and all values inside it.
template <class Visit>
bool visit_all(const Json& value, int depth, const Visit& visit) {
  if (depth > kDeepest || !visit(value)) return false;
  if (!value.is_structured()) return true;
  for (const Json& child : value) {
    if (!visit_all(child, depth + 1, visit)) return false;
  }
  return true;
}

class UseFinder {
 public:
  UseFinder(const GltfFile& gltf, const std::function<bool(std::size_t, std::size_t)>& is_replaced)
      : gltf_(gltf), is_replaced_(is_replaced) {
    uses_.accessors.resize(gltf.count("accessors"));
    uses_.views.resize(gltf.count("bufferViews"));
  }

  GltfUses run() {
    add_primitives();
    add_animations();
    for_each("skins", [&](const Json& skin) { add_accessor(skin, "inverseBindMatrices"); });
    for_each("nodes", [&](const Json& node) {
      if (const Json* instances = gltf_.extension(node, "EXT_mesh_gpu_instancing"))
        add_values(*instances, "attributes");
    });
    for_each("images", [&](const Json& image) { add_view(image, "bufferView"); });
    add_unknown_extensions();
    add_views_of_accessors();
    return std::move(uses_);
  }

 private:
  template <class Visit>
  void for_each(const char* array, const Visit& visit) {
    for (std::size_t i = 0; i < gltf_.count(array); ++i)
      visit(gltf_.element(array, i));
  }
  static void add(std::vector<bool>& uses, const Json& index) {
    if (!index.is_number_unsigned()) return;
    const auto number = index.get<std::uint64_t>();
    if (number < uses.size()) uses[number] = true;
  }
  void add_accessor(const Json& object, const char* key) {
    if (object.is_object() && object.contains(key)) add(uses_.accessors, object[key]);
  }
  void add_view(const Json& object, const char* key) {
    if (object.is_object() && object.contains(key)) add(uses_.views, object[key]);
  }
  /// Adds the values of an object at `key`, which are accessors.
  void add_values(const Json& object, const char* key) {
    const auto values = object.find(key);
    if (values == object.end() || !values->is_object()) return;
    for (const Json& value : *values)
      add(uses_.accessors, value);
  }

  void add_primitives() {
    for (std::size_t mesh = 0; mesh < gltf_.count("meshes"); ++mesh) {
      const Json& json = gltf_.element("meshes", mesh);
      const auto primitives = json.find("primitives");
      if (primitives == json.end() || !primitives->is_array()) continue;
      for (std::size_t i = 0; i < primitives->size(); ++i) {
        if ((*primitives)[i].is_object() && !is_replaced_(mesh, i)) add_primitive((*primitives)[i]);
      }
    }
  }

  void add_primitive(const Json& primitive) {
    add_values(primitive, "attributes");
    add_accessor(primitive, "indices");
    const auto targets = primitive.find("targets");
    if (targets != primitive.end() && targets->is_array()) {
      for (const Json& target : *targets) {
        if (!target.is_object()) continue;
        for (const Json& accessor : target)
          add(uses_.accessors, accessor);
      }
    }
    if (const Json* draco = gltf_.extension(primitive, "KHR_draco_mesh_compression"))
      add_view(*draco, "bufferView");
  }

  void add_animations() {
    for_each("animations", [&](const Json& animation) {
      const auto samplers = animation.find("samplers");
      if (samplers == animation.end() || !samplers->is_array()) return;
      for (const Json& sampler : *samplers) {
        add_accessor(sampler, "input");
        add_accessor(sampler, "output");
      }
    });
  }

  void add_unknown_extensions() {
    const auto add_numbers = [&](const Json& value) {
      add(uses_.accessors, value);
      add(uses_.views, value);
      return true;
    };
    const bool is_shallow = visit_all(gltf_.root(), 0, [&](const Json& value) {
      if (!value.is_object() || !value.contains("extensions")) return true;
      for (const auto& [name, extension] : value["extensions"].items()) {
        if (!is_shape_known(name) && !visit_all(extension, 0, add_numbers)) return false;
      }
      return true;
    });
    if (!is_shallow) gltf_.fail("the document is nested too deeply");
  }

  void add_views_of_accessors() {
    for (std::size_t i = 0; i < uses_.accessors.size(); ++i) {
      if (!uses_.accessors[i]) continue;
      const Json& accessor = gltf_.element("accessors", i);
      add_view(accessor, "bufferView");
      const auto sparse = accessor.find("sparse");
      if (sparse == accessor.end() || !sparse->is_object()) continue;
      for (const char* part : {"indices", "values"}) {
        if (sparse->contains(part)) add_view((*sparse)[part], "bufferView");
      }
    }
  }

  const GltfFile& gltf_;
  const std::function<bool(std::size_t, std::size_t)>& is_replaced_;
  GltfUses uses_;
};

}  // namespace

GltfUses find_uses(const GltfFile& gltf,
                   const std::function<bool(std::size_t, std::size_t)>& is_replaced) {
  return UseFinder(gltf, is_replaced).run();
}

void check_depth(const GltfFile& gltf) {
  if (!visit_all(gltf.root(), 0, [](const Json&) { return true; }))
    gltf.fail("the document is nested too deeply");
}

bool has_extension(const Json& root, std::string_view name) {
  bool is_found = false;
  visit_all(root, 0, [&](const Json& value) {
    if (value.is_object() && value.contains("extensions"))
      is_found |= value["extensions"].contains(std::string(name));
    return !is_found;
  });
  return is_found;
}

}  // namespace mesher::io

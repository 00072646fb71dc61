#include "tests/support/content_samples.h"

#include <algorithm>

#include "tests/support/gltf_document.h"

namespace mesher::test {
namespace {

std::string obj_with(const std::string& lines) {
  return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n" +
         lines + "f 1 2 3\nf 1 3 4\n";
}

std::string gltf_with(const std::string& root, const std::string& attributes = "",
                      const std::string& primitive = "", const std::string& node = "") {
  GltfDocument document;
  document.floats(kSquareCorners, "VEC3", 3);
  document.indices(kSquareIndices);
  document.floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2);
  document.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0}, "VEC3", 3);
  document.floats({1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1}, "VEC4", 4);
  document.view(std::string(16, '\0'));
  document.accessor("\"bufferView\":5", 5121, "VEC4", 4);
  document.floats({0, 0, 1}, "VEC3", 3);
  return document.text(root + (root.empty() ? "" : ",") + R"("nodes":[{"mesh":0)" + node +
                       R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0)" + attributes +
                       R"(},"indices":1)" + primitive + "}]}]");
}

std::string ply_with(const std::string& properties, const std::string& values) {
  return "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\n"
         "property float y\nproperty float z\n" +
         properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0" +
         values + "\n1 0 0" + values + "\n0 1 0" + values + "\n3 0 1 2\n";
}

/// What is no triangle.
std::vector<ContentSample> geometry_samples() {
  return {
      {Content::points, ".obj", obj_with("p 1 2\n"), {"2 points"}},
      {Content::points,
       ".gltf",
       gltf_with("", "", R"(},{"attributes":{"POSITION":0},"mode":0)"),
       {"4 points"}},
      {Content::lines, ".obj", obj_with("l 1 2 3\n"), {"1 line"}},
      {Content::curves, ".obj", obj_with("curv 0 1 1 2\n"), {"free-form"}},
  };
}

/// Values of vertices and faces.
std::vector<ContentSample> attribute_samples() {
  const std::string uv = R"(,"TEXCOORD_0":2)";
  return {
      {Content::uv_sets, ".obj", obj_with("f 1/1 2/2 3/3\n"), {"texture coordinates"}},
      {Content::uv_sets, ".gltf", gltf_with("", uv + R"(,"TEXCOORD_1":2)"), {"2 UV sets"}},
      {Content::uv_sets, ".gltf", gltf_with("", uv), {"texture coordinates"}},
      {Content::normals, ".gltf", gltf_with("", R"(,"NORMAL":3)"), {"normals"}},
      {Content::normals, ".obj", obj_with("f 1//1 2//1 3//2\n"), {"normals"}},
      {Content::tangents, ".gltf", gltf_with("", R"(,"TANGENT":4)"), {"tangents"}},
      {Content::color_sets,
       ".gltf",
       gltf_with("", R"(,"COLOR_0":4,"COLOR_1":4)"),
       {"2 color sets"}},
      {Content::color_sets,
       ".ply",
       ply_with("property uchar red\nproperty uchar green\n", " 9 8"),
       {"colors"}},
      {Content::color_sets,
       ".off",
       "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n",
       {"colors"}},
      {Content::joint_sets, ".gltf", gltf_with("", R"(,"JOINTS_0":5,"WEIGHTS_0":4)"), {"joints"}},
  };
}

/// Groups, materials and textures.
std::vector<ContentSample> material_samples() {
  return {
      {Content::groups, ".obj", obj_with("g a\nf 1 2 4\ng b\n"), {"group"}},
      {Content::groups, ".obj", obj_with("g only\n"), {"1 group: only"}},
      {Content::objects, ".obj", obj_with("o Box\n"), {"1 object: Box"}},
      {Content::smoothing_groups, ".obj", obj_with("s 1\n"), {"smoothing group"}},
      {Content::materials, ".obj", obj_with("usemtl brick\n"), {"1 material: brick"}},
      {Content::materials, ".gltf", gltf_with(R"("materials":[{"name":"m"}])"), {"1 material: m"}},
      {Content::material_files, ".obj", obj_with("mtllib a.mtl\n"), {"material file: a.mtl"}},
      {Content::textures, ".gltf", gltf_with(R"("textures":[{}])"), {"1 texture"}},
      {Content::textures,
       ".ply",
       ply_with("", ""),
       {"1 texture: a.png", "texture a.png (it could not be read)"}},
  };
}

/// How a file arranges and moves meshes.
std::vector<ContentSample> scene_samples() {
  return {
      {Content::nodes, ".gltf", gltf_with("", "", "", R"(,"name":"house")"), {"1 node: house"}},
      {Content::instances,
       ".gltf",
       gltf_with("", "", "",
                 R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":6}}})"),
       {"1 instance"}},
      {Content::skins, ".gltf", gltf_with(R"("skins":[{"joints":[0]}])"), {"1 skin"}},
      {Content::animations, ".gltf", gltf_with(R"("animations":[{}])"), {"1 animation"}},
      {Content::morph_targets,
       ".gltf",
       gltf_with("", "", R"(,"targets":[{"POSITION":3}])"),
       {"1 morph target"}},
      {Content::cameras, ".gltf", gltf_with(R"("cameras":[{}])"), {"1 camera"}},
      {Content::lights,
       ".gltf",
       gltf_with(R"("extensions":{"KHR_lights_punctual":{"lights":[{}]}})"),
       {"1 light"}},
      {Content::variants,
       ".gltf",
       gltf_with(R"("extensions":{"KHR_materials_variants":{"variants":[{}]}})"),
       {"variant"}},
  };
}

/// What only the author knows.
std::vector<ContentSample> unknown_samples() {
  return {
      {Content::extensions, ".gltf", gltf_with(R"("extensionsUsed":["VENDOR_x"])"), {"VENDOR_x"}},
      {Content::extras, ".gltf", gltf_with(R"("extras":{})"), {"extras"}},
      {Content::own_properties, ".gltf", gltf_with("", R"(,"_HEAT":3)"), {"_HEAT"}},
      {Content::own_properties,
       ".ply",
       ply_with("property float quality\n", " 1"),
       {"vertex quality"}},
      {Content::own_properties, ".obj", obj_with("bevel on\n"), {"bevel"}},
  };
}

}  // namespace

std::vector<ContentSample> content_samples() {
  std::vector<ContentSample> all;
  for (const auto& samples : {geometry_samples(), attribute_samples(), material_samples(),
                              scene_samples(), unknown_samples()}) {
    all.insert(all.end(), samples.begin(), samples.end());
  }
  return all;
}

bool names_any(const std::vector<std::string>& losses, const std::vector<std::string>& words) {
  return std::any_of(losses.begin(), losses.end(), [&](const std::string& loss) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return loss.find(word) != std::string::npos;
    });
  });
}

}  // namespace mesher::test

#pragma once

#include <string>

#include "tests/support/gltf_document.h"

namespace mesher::test {

/// A glTF file with much to keep. Mesh 0 "sheet" has two squares side by side: primitive 0 in
/// material 0 with texture coordinates, primitive 1 in material 1. Mesh 1 has four points. Node 0
/// "root" moves its children: "a" shows the sheet twice as large and has a child with a camera, and
/// "b" shows it again. An animation turns "a"; an extension that nobody knows refers to accessor 5.
inline std::string scene_file() {
  GltfDocument file;
  file.floats(kSquareCorners, "VEC3", 3);                        // 0
  file.indices(kSquareIndices);                                  // 1
  file.floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2);              // 2
  file.floats({1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0}, "VEC3", 3);  // 3
  file.floats({0, 1}, "SCALAR", 1);                              // 4: times
  file.floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4", 4);              // 5: turns
  return file.text(R"("scene":0,"scenes":[{"name":"all","nodes":[0]}],
    "extensionsUsed":["VENDOR_rig"],"extensions":{"VENDOR_rig":{"curve":5}},
    "extras":{"author":"somebody"},
    "nodes":[{"name":"root","translation":[10,0,0],"children":[1,3]},
      {"name":"a","mesh":0,"scale":[2,2,2],"children":[2]},{"name":"eye","camera":0},
      {"name":"b","mesh":0,"extras":{"id":7}},{"name":"dust","mesh":1}],
    "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],
    "materials":[{"name":"brick"},{"name":"paper","extensions":{"KHR_materials_unlit":{}}}],
    "animations":[{"name":"turn","channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}],
      "samplers":[{"input":4,"output":5}]}],
    "meshes":[{"name":"sheet","primitives":[
        {"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0,"extras":"left"},
        {"attributes":{"POSITION":3},"indices":1,"material":1}]},
      {"name":"dust","primitives":[{"attributes":{"POSITION":0},"mode":0}]}])");
}

}  // namespace mesher::test

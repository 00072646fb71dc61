#include "tests/support/bytes.h"
#include "tests/support/gltf_document.h"
#include "tests/support/zoo.h"
#include "tests/support/zoo_text.h"

namespace mesher::test {
namespace {

const std::string kData = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
                          bytes_of<std::uint16_t>({0, 1, 2, 0, 3, 1});
const std::string kBuffer =
    R"("buffers":[{"byteLength":60,"uri":"data:;base64,)" + base64(kData) + "\"}],";
const std::string kViews =
    R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)";
const std::string kAccessors =
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)";
const std::string kPrimitive = R"({"attributes":{"POSITION":0},"indices":1})";
const std::string kMeshes = R"("meshes":[{"primitives":[)" + kPrimitive + "]}]";

std::string document(const std::string& nodes = "", const std::string& meshes = kMeshes) {
  return R"({"asset":{"version":"2.0"},)" + kBuffer + kViews + kAccessors + nodes + meshes + "}";
}

/// The valid document with one piece of text replaced.
std::string altered(const std::string& what, const std::string& with) {
  std::string text = document();
  text.replace(text.find(what), what.size(), with);
  return text;
}

std::string word(std::uint32_t value) {
  return bytes_of<std::uint32_t>({value});
}

std::string glb(const std::string& json, const std::string& data) {
  const auto size = [](const std::string& text) { return static_cast<std::uint32_t>(text.size()); };
  return "glTF" + word(2) + word(28 + size(json) + size(data)) + word(size(json)) + "JSON" + json +
         word(size(data)) + std::string("BIN\0", 4) + data;
}

std::string chain_of_nodes() {
  std::string nodes = "\"nodes\":[";
  for (int i = 0; i < kMany; ++i)
    nodes += R"({"children":[)" + std::to_string(i + 1) + "]},";
  return nodes + R"({"mesh":0}],"scenes":[{"nodes":[0]}],)";
}

}  // namespace

std::string sound_gltf() {
  return document();
}
/// Sparse positions, an instance, a skin with a bone, a morph target, and an animation of both.
std::string posed_gltf() {
  GltfDocument file;
  const auto view = [&](const std::string& bytes) { return std::to_string(file.view(bytes)); };
  file.accessor(R"("bufferView":)" + view(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5})) +
                    R"(,"sparse":{"count":1,"indices":{"bufferView":)" + view("\3") +
                    R"(,"componentType":5121},"values":{"bufferView":)" +
                    view(bytes_of<float>({0, 0, 1})) + "}}",
                5126, "VEC3", 4);
  file.indices({0, 1, 2, 0, 3, 1});
  file.accessor(R"("bufferView":)" + view(std::string(16, '\0')), 5121, "VEC4", 4);
  file.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  file.floats({0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3", 3);
  file.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}, "MAT4", 16);
  file.floats({7, 0, 0}, "VEC3", 3);
  file.floats({0, 1}, "SCALAR", 1);
  file.accessor(R"("normalized":true,"bufferView":)" +
                    view(bytes_of<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0})),
                5122, "VEC4", 2);
  file.floats({0, 0, 0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 4, 0, 0, 0, 0}, "VEC3", 3);
  file.floats({0.5F, 1}, "SCALAR", 1);
  return file.text(
      R"("animations":[{"name":"a","channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}},
      {"sampler":1,"target":{"node":1,"path":"translation"}},
      {"sampler":2,"target":{"node":0,"path":"weights"}},{"sampler":9,"target":{"path":"pointer"}}],
      "samplers":[{"input":7,"output":8},{"input":7,"output":9,"interpolation":"CUBICSPLINE"},
      {"input":7,"output":10,"interpolation":"STEP"}]}],)"
      R"("nodes":[{"mesh":0,"skin":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":
      {"TRANSLATION":6}}}},{"translation":[0,2,0]}],"skins":[{"joints":[1],"inverseBindMatrices":5}],
      "meshes":[{"weights":[0.5],"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},
      "indices":1,"targets":[{"POSITION":4}]}]}])");
}

std::string sound_glb() {
  std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":60}],)" + kViews +
                     kAccessors + kMeshes + "}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return glb(json, kData);
}

namespace {

void add_documents(const Enclosure& pen) {
  pen.refused("not JSON", "hello");
  pen.refused("JSON cut short", document().substr(0, document().size() / 2));
  pen.refused("nested a million deep", repeated("[", 1000000));
  pen.refused("nested a million deep and back", repeated("[", 1000000) + repeated("]", 1000000));
  pen.refused("extras nested a million deep without end",
              R"({"asset":{"version":"2.0"},"extras":)" + repeated("[", 1000000));
  pen.read("extras nested deep",
           altered(R"("asset")",
                   R"("extras":)" + repeated("[", kMany) + repeated("]", kMany) + R"(,"asset")"),
           2);
  pen.refused("malformed UTF-8", altered(R"("asset")", "\"\xC0\xAF\":1,\"asset\""));
  pen.refused("a number past doubles", altered(R"("count":4)", R"("count":1e999)"));
  pen.refused("version 1", altered(R"("version":"2.0")", R"("version":"1.0")"));
  pen.refused("no meshes", document("", R"("x":0)"));
}

void add_nodes(const Enclosure& pen) {
  pen.refused("node that is its own child",
              document(R"("nodes":[{"children":[0],"mesh":0}],"scenes":[{"nodes":[0]}],)"));
  pen.refused("nodes in a circle",
              document(R"("nodes":[{"children":[1]},{"children":[0]}],"scenes":[{"nodes":[0]}],)"));
  pen.refused("node with two parents",
              document(R"("nodes":[{"children":[1,2]},{"children":[2]},{"mesh":0}],)"));
  pen.refused("scene that names a node twice",
              document(R"("nodes":[{"mesh":0}],"scenes":[{"nodes":[0,0]}],)"));
  pen.refused("circle without roots", document(R"("nodes":[{"children":[1]},{"children":[0]}],)"));
  pen.read("a hundred thousand nodes in a chain", document(chain_of_nodes()), 2);
  pen.refused("child out of range", document(R"("nodes":[{"children":[7]}],)"));
  pen.refused("child below zero", document(R"("nodes":[{"children":[-1]}],)"));
  pen.refused("scene out of range", document(R"("nodes":[{"mesh":0}],"scenes":[{}],"scene":5,)"));
  pen.refused("mesh out of range", document(R"("nodes":[{"mesh":4294967296}],)"));
  pen.refused("scaled to infinity", document(R"("nodes":[{"mesh":0,"scale":[1e300,1e300]}],)"));
  pen.read(
      "translated beyond the largest float",
      document(R"("nodes":[{"mesh":0,"scale":[1e300,1e300,1e300],"translation":[1e300,0,0]}],)"), 0,
      {{Repair::non_finite_vertices_dropped, 4}});
}

void add_data(const Enclosure& pen) {
  pen.refused("accessor that claims billions", altered(R"("count":4)", R"("count":4000000000)"));
  pen.refused("accessor whose size overflows",
              altered(R"("count":4)", R"("count":1537228672809129302)"));
  pen.refused("accessor of a fraction", altered(R"("count":4)", R"("count":4.5)"));
  pen.refused("accessor count below zero", altered(R"("count":4)", R"("count":-4)"));
  pen.refused("accessor without a view that claims billions",
              altered(R"("bufferView":0,"componentType":5126,"count":4)",
                      R"("componentType":5126,"count":4000000000)"));
  pen.refused("view past its buffer",
              altered(R"("byteOffset":48,"byteLength":12)", R"("byteOffset":48,"byteLength":16)"));
  pen.refused("view offset that overflows",
              altered(R"("byteOffset":48)", R"("byteOffset":18446744073709551608)"));
  pen.refused("view of a missing buffer",
              altered(R"({"buffer":0,"byteLength":48})", R"({"buffer":1,"byteLength":48})"));
  pen.refused("stride zero", altered(R"("byteLength":48)", R"("byteLength":48,"byteStride":0)"));
  pen.refused(
      "stride that overflows",
      altered(R"("byteLength":48)", R"("byteLength":48,"byteStride":18446744073709551615)"));
  pen.refused("buffer shorter than it says", altered(R"("byteLength":60)", R"("byteLength":61)"));
  pen.refused("buffer of damaged base64", altered("base64,", "base64,####"));
  pen.refused("buffer that is a device", altered("data:;base64,", "/dev/zero\",\"x\":\""));
  pen.refused("buffer outside the folder",
              altered("data:;base64,", "../../../../dev/zero\",\"x\":\""));
  pen.refused("indices that are fractions", altered("5123", "5126"));
  pen.refused("indices past the vertices", altered(R"("count":4)", R"("count":3)"));
  pen.refused("unknown component type", altered("5126", "9999"));
}

void add_primitives(const Enclosure& pen) {
  pen.refused("primitives that are numbers", document("", R"("meshes":[{"primitives":[1,2]}])"));
  pen.refused("meshes that are not an array", document("", R"("meshes":7)"));
  pen.refused(
      "points alone",
      document("", R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":0}]}])"));
  pen.read("compression required and not used",
           altered(R"("asset")", R"("extensionsRequired":["EXT_meshopt_compression"],"asset")"), 2);
  pen.refused("an extension required that nobody knows",
              altered(R"("asset")",
                      R"("extensionsRequired":[")" + std::string(5000, 'x') + R"("],"asset")"));
  pen.refused("Draco data that is none",
              altered(kPrimitive, R"({"attributes":{"POSITION":0},"extensions":
              {"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}})"));
  pen.refused("a primitive a hundred thousand times a hundred thousand",
              document("\"nodes\":[" + repeated(R"({"mesh":0},)", kMany) + R"({"mesh":0}],)",
                       R"("meshes":[{"primitives":[)" + repeated(kPrimitive + ",", kMany) +
                           kPrimitive + "]}]"));
  pen.read("long names in a hundred thousand nodes",
           document("\"nodes\":[" + repeated(R"({"mesh":0},)", kMany) + R"({"mesh":0}],)",
                    R"("meshes":[{"name":")" + std::string(1000000, 'n') + R"(","primitives":[)" +
                        kPrimitive + "]}]"),
           2 * (kMany + 1));
}

void add_glb(const Enclosure& pen) {
  const std::string sound = sound_glb();
  pen.refused("GLB empty", "");
  pen.refused("GLB of its magic alone", "glTF");
  pen.refused("GLB of version 1", "glTF" + word(1) + sound.substr(8));
  pen.refused("GLB longer than it is", "glTF" + word(2) + word(0xFFFFFFFFU) + sound.substr(12));
  pen.refused("GLB chunk longer than the file",
              sound.substr(0, 12) + word(0xFFFFFFF0U) + sound.substr(16));
  pen.refused("GLB without JSON",
              "glTF" + word(2) + word(28) + word(8) + std::string("BIN\0", 4) + word(0) + word(0));
  pen.refused("GLB of empty JSON", glb("", kData));
  pen.refused("GLB cut in its data", sound.substr(0, sound.size() - 10));
  pen.refused("GLB without its data", "glTF" + word(2) +
                                          word(static_cast<std::uint32_t>(sound.size() - 68)) +
                                          sound.substr(12, sound.size() - 80));
}

}  // namespace

void add_gltf(std::vector<Specimen>& zoo) {
  const Enclosure pen(zoo, ".gltf");
  add_documents(pen);
  add_nodes(pen);
  add_data(pen);
  add_primitives(pen);
  add_glb(Enclosure(zoo, ".glb"));
}

}  // namespace mesher::test

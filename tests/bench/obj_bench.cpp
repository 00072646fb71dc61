#include <benchmark/benchmark.h>
#include <tiny_obj_loader.h>

#include <assimp/scene.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <string>

#include "engine/io/read.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;

void finish(State& state, const std::string& file, std::size_t faces, std::size_t expected) {
  if (faces != expected) state.SkipWithError("did not read every face");
  state.SetBytesProcessed(static_cast<std::int64_t>(std::filesystem::file_size(file)));
}

void read_ours(State& state, const std::string& file, std::size_t expected) {
  Soup soup;
  for (auto _ : state)
    soup = io::read_soup(file);
  finish(state, file, soup.face_count(), expected);
}

void read_tinyobjloader(State& state, const std::string& file, std::size_t expected) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  for (auto _ : state) {
    std::vector<tinyobj::material_t> materials;
    std::string warning;
    std::string error;
    tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, file.c_str());
  }
  std::size_t faces = 0;
  for (const auto& shape : shapes)
    faces += shape.mesh.num_face_vertices.size();
  finish(state, file, faces, expected);
}

void read_assimp(State& state, const std::string& file, std::size_t expected) {
  Assimp::Importer importer;
  for (auto _ : state)
    importer.ReadFile(file, 0);  // no postprocessing
  std::size_t faces = 0;
  const aiScene* scene = importer.GetScene();
  for (unsigned m = 0; scene != nullptr && m < scene->mNumMeshes; ++m) {
    faces += scene->mMeshes[m]->mNumFaces;
  }
  finish(state, file, faces, expected);
}

void read_and_build_ours(State& state, const std::string& file, std::size_t expected) {
  Model model;
  for (auto _ : state)
    model = io::read_model(file);
  finish(state, file, model.mesh.face_count(), expected);
}

void read_and_build_openmesh(State& state, const std::string& file, std::size_t expected) {
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  for (auto _ : state)
    OpenMesh::IO::read_mesh(mesh, file);
  finish(state, file, mesh.n_faces(), expected);
}

template <class Read>
void add(const std::string& name, Read read, const std::string& file, std::size_t expected) {
  benchmark::RegisterBenchmark(name.c_str(), [=](State& state) { read(state, file, expected); })
      ->Iterations(1)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_obj(const Settings& settings) {
  const auto make = [&](const char* name, ObjContent content) {
    const auto file = settings.folder / (name + std::to_string(settings.obj_bytes) + ".obj");
    write_obj(file, settings.obj_bytes, content);
    return file.string();
  };
  const std::string plain = make("plain_", ObjContent::positions);
  const std::string full = make("full_", ObjContent::positions_texcoords_normals);
  const std::size_t plain_faces = io::read_soup(plain).face_count();
  const std::size_t full_faces = io::read_soup(full).face_count();

  add("obj_arrays/mesher", read_ours, plain, plain_faces);
  add("obj_arrays/tinyobjloader", read_tinyobjloader, plain, plain_faces);
  add("obj_arrays/assimp", read_assimp, plain, plain_faces);
  add("obj_full_arrays/mesher", read_ours, full, full_faces);
  add("obj_full_arrays/tinyobjloader", read_tinyobjloader, full, full_faces);
  add("obj_full_arrays/assimp", read_assimp, full, full_faces);
  add("obj_mesh/mesher", read_and_build_ours, plain, plain_faces);
  add("obj_mesh/OpenMesh", read_and_build_openmesh, plain, plain_faces);
}

}  // namespace mesher::bench

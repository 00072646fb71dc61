#include "app/document/scene_picture.h"

#include <algorithm>

#include "app/document/session.h"
#include "engine/io/read.h"
#include "engine/render/offscreen.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/gpu_test.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

constexpr std::uint32_t kSide = 120;

/// A skinned and morphed strip of squares: joint 1 turns its upper half, and a target bends it.
std::string skinned_file() {
  test::GltfDocument file;
  file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}, "VEC3", 3);  // 0
  file.indices({0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4});                              // 1
  const std::string joints("\0\0\0\0\0\0\0\0\0\1\0\0\0\1\0\0\1\0\0\0\1\0\0\0", 24);
  file.accessor(R"("bufferView":)" + std::to_string(file.view(joints)), 5121, "VEC4", 6);  // 2
  file.floats({1, 0, 0, 0, 1, 0, 0, 0, .5F, .5F, 0, 0, .5F, .5F, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
              "VEC4", 4);                                                              // 3
  file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);      // 4
  file.floats({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, .5F, 1, 0, .5F}, "VEC3", 3);  // 5
  file.floats({0, 1}, "SCALAR", 1);                                                    // 6
  file.floats({0, 0, 0, 1, .3F, 0, .8F, .5F}, "VEC4", 4);                              // 7
  file.floats({0, 1}, "SCALAR", 1);                                                    // 8
  return file.text(R"("scene":0,"scenes":[{"nodes":[0,1,2]}],
    "nodes":[{"mesh":0,"skin":0},{"name":"hip","children":[3]},
      {"name":"copy","mesh":0,"translation":[2,0,0],"scale":[1,0.5,2]},{"name":"knee"}],
    "skins":[{"joints":[1,3]}],
    "animations":[{"name":"kick","channels":[
        {"sampler":0,"target":{"node":3,"path":"rotation"}},
        {"sampler":1,"target":{"node":0,"path":"weights"}}],
      "samplers":[{"input":6,"output":7},{"input":6,"output":8}]}],
    "meshes":[{"weights":[0],"primitives":[{"indices":1,"targets":[{"POSITION":5}],
      "attributes":{"POSITION":0,"NORMAL":4,"JOINTS_0":2,"WEIGHTS_0":3}}]}])");
}

class ScenePictureTest : public test::GpuTest {
 protected:
  void show(const std::string& text) {
    show_model(session_, io::read_model(folder_.write("s.gltf", text), {.keeps_scene = true}),
               "s.gltf");
    session_.view.camera.set_angles(0.4, 0.3);
    session_.view.camera.frame({glm::vec3(-1.0F, -1.0F, -2.0F), glm::vec3(4.0F, 3.0F, 2.0F)}, 1.0);
  }
  Image draw(Mesh mesh, const render::Settings& settings, const render::Sources& sources) {
    return render::render_image(device(), mesh, session_.view.camera, settings, kSide, kSide,
                                sources);
  }
  /// What the vertex shader moves, beside what the CPU has moved.
  void expect_same_picture(const render::Settings& settings) {
    const Document& document = session_.document;
    const Model& model = document.model;
    ScenePicture picture(document);
    picture.pose(document);
    render::Sources by_shader{.pose = picture.pose_source()};
    by_shader.appearance.attributes = &picture.attributes();
    scene::Copies copies = copies_of(model.mesh, model.attributes, *model.scene);
    pose(*model.scene, shown_poses(document), copies);
    render::Sources by_cpu;
    by_cpu.appearance.attributes = &copies.shape.attributes;
    const Image shader = draw(picture.mesh(), settings, by_shader);
    const Image cpu = draw(copies.shape.mesh, settings, by_cpu);
    const auto drawn = std::ranges::count_if(cpu.rgba, [&](auto c) { return c != cpu.rgba[0]; });
    EXPECT_GT(drawn, 1000);
    std::size_t different = 0;
    for (std::size_t i = 0; i < cpu.rgba.size(); ++i)
      different += std::abs(int(shader.rgba[i]) - int(cpu.rgba[i])) > 2 ? 1U : 0U;
    EXPECT_LE(different, cpu.rgba.size() / 500);  // rounding moves a pixel at a border
  }

  test::TempFolder folder_;
  Session session_;
};

TEST_F(ScenePictureTest, TheShaderPosesAsTheCpuDoes) {
  show(skinned_file());
  using render::Look;
  using render::Shading;
  for (const double time : {0.0, 0.4, 1.0}) {
    session_.document.playback = {.animation = 0, .time_s = time};
    for (const bool wire : {false, true}) {
      for (const render::Settings& settings :
           {render::Settings{.look = Look::clay, .wireframe = wire},
            render::Settings{.shading = Shading::none, .wireframe = true},
            render::Settings{.look = Look::normals, .wireframe = wire}}) {
        SCOPED_TRACE("at " + std::to_string(time));
        expect_same_picture(settings);
      }
    }
  }
}

// The normals of vertices are those at rest, turned: of rigid meshes, the same.
TEST_F(ScenePictureTest, NormalsOfVerticesTurnWithTheirMesh) {
  show(test::scene_file());
  session_.view.camera.frame({glm::vec3(9.0F, -3.0F, -1.0F), glm::vec3(14.0F, 3.0F, 1.0F)}, 1.0);
  session_.document.playback = {.animation = 0, .time_s = 0.3};
  for (const bool wire : {false, true}) {
    for (const float angle : {180.0F, 30.0F}) {
      expect_same_picture({.shading = render::Shading::gouraud,
                           .look = render::Look::clay,
                           .wireframe = wire,
                           .crease_angle_deg = angle});
    }
  }
}

TEST_F(ScenePictureTest, OnlyMorphTargetsChangeTheMesh) {
  show(skinned_file());
  ScenePicture picture(session_.document);
  EXPECT_TRUE(picture.pose(session_.document)) << "the first time";
  session_.document.playback = {.animation = 0, .time_s = 0.0};
  EXPECT_FALSE(picture.pose(session_.document));
  session_.document.playback.time_s = 0.5;
  EXPECT_TRUE(picture.pose(session_.document));
  show(test::scene_file());
  ScenePicture rigid(session_.document);
  session_.document.playback = {.animation = 0, .time_s = 0.5};
  EXPECT_FALSE(rigid.pose(session_.document));
}

}  // namespace
}  // namespace mesher::app

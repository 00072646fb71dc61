#include "engine/render/draw_order.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/render/painted_quads.h"

namespace mesher::render {
namespace {

std::vector<std::uint32_t> materials_of(const DrawOrder& order) {
  std::vector<std::uint32_t> materials;
  for (const Batch& batch : order.batches)
    materials.push_back(batch.material);
  return materials;
}

TEST(DrawOrder, OneMaterialNeedsNoOrder) {
  const PaintedModel model = quads({0.0F});
  const DrawOrder order = draw_order(model.mesh, model.attributes, &model.materials);
  EXPECT_TRUE(order.faces.empty());
  ASSERT_EQ(order.batches.size(), 1U);
  EXPECT_EQ(order.batches[0].count, 2U);
}

TEST(DrawOrder, MeshWithoutGroupsHasNoMaterial) {
  PaintedModel model = quads({0.0F});
  model.attributes.group.clear();
  model.attributes.groups.clear();
  for (const Materials* materials : {&std::as_const(model.materials), (const Materials*)nullptr}) {
    const DrawOrder order = draw_order(model.mesh, model.attributes, materials);
    ASSERT_EQ(order.batches.size(), 1U);
    EXPECT_EQ(order.batches[0].material, materials == nullptr ? 0U : 1U);
    EXPECT_EQ(order.batches[0].count, 2U);
  }
}

TEST(DrawOrder, FacesThatBlendComeLast) {
  PaintedModel model = quads({0.0F, 1.0F, 2.0F});
  model.materials.materials[0].alpha = AlphaMode::blend;
  const DrawOrder order = draw_order(model.mesh, model.attributes, &model.materials);
  EXPECT_EQ(materials_of(order), (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_TRUE(order.batches[2].blends);
  EXPECT_EQ(order.batches[2].center, glm::vec3(0.0F));
  std::vector<bool> is_drawn(6);
  for (const std::uint32_t face : order.faces)
    is_drawn[face] = true;
  EXPECT_EQ(is_drawn, std::vector<bool>(6, true));
}

TEST(DrawOrder, LevelsAreTheFirstFacesOfEachBatch) {
  PaintedModel model = quads({0.0F, 1.0F, 2.0F});
  model.materials.materials[2].alpha = AlphaMode::blend;
  // Six faces of the materials 0, 0, 1, 1, 2, 2; a level has the first of them.
  const DrawOrder all = order_of_faces(6, model.attributes, &model.materials);
  for (const std::vector<float>& depths :
       {std::vector<float>{0.0F}, {0.0F, 1.0F}, {0.0F, 1.0F, 2.0F}}) {
    const PaintedModel level = quads(depths);
    const DrawOrder own = draw_order(level.mesh, model.attributes, &model.materials);
    const std::vector<Batch> batches = batches_of_level(all, level.mesh);
    ASSERT_EQ(batches.size(), depths.size());
    ASSERT_EQ(own.batches.size(), depths.size());
    for (std::size_t i = 0; i < batches.size(); ++i) {
      EXPECT_EQ(batches[i].material, own.batches[i].material);
      EXPECT_EQ(batches[i].count, 2U);
      EXPECT_EQ(batches[i].center, own.batches[i].center);
      for (std::uint32_t f = 0; f < 2; ++f)
        EXPECT_EQ(all.faces[batches[i].first + f], own.faces[own.batches[i].first + f]);
    }
  }
}

TEST(DrawOrder, UnknownMaterialsAreNone) {
  PaintedModel model = quads({0.0F, 1.0F, 2.0F});
  model.attributes.groups[1].material = kNone;
  model.attributes.groups[2].material = 17;
  const DrawOrder order = draw_order(model.mesh, model.attributes, &model.materials);
  EXPECT_EQ(materials_of(order), (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(order.batches[1].count, 4U);
}

TEST(DrawOrder, OpaqueGroupsOfOneMaterialAreDrawnTogether) {
  PaintedModel model = quads({0.0F, 1.0F});
  model.attributes.groups[1].material = 0;
  EXPECT_EQ(draw_order(model.mesh, model.attributes, &model.materials).batches.size(), 1U);
  model.materials.materials[0].alpha = AlphaMode::blend;
  EXPECT_EQ(draw_order(model.mesh, model.attributes, &model.materials).batches.size(), 2U);
}

}  // namespace
}  // namespace mesher::render

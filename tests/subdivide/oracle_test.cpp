// The oracles against values worked out by hand, and against OpenSubdiv.
#include <gtest/gtest.h>

#include "tests/subdivide/derose98_oracle.h"
#include "tests/subdivide/hoppe94_oracle.h"
#include "tests/subdivide/models.h"
#include "tests/subdivide/opensubdiv_reference.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

TEST(Oracle, Scratch) {
  for (const CreaseDecay decay : {CreaseDecay::uniform, CreaseDecay::chaikin})
    for (const BoundaryRounding b : {BoundaryRounding::edge_only, BoundaryRounding::edge_and_corner})
      for (const Model& m : models()) {
        const std::uint32_t levels = affordable_levels(m.mesh, 3);
        OpenSubdivReference ref(m.mesh, b, decay, levels);
        PlainMesh p = plain_mesh(m.mesh, b);
        double worst = 0;
        for (std::uint32_t l = 1; l <= levels; ++l) {
          p = refine(p, derose98_rules(decay));
          const double d = largest_distance(p.positions, ref.level(l).positions) / diagonal(p.positions);
          worst = std::max(worst, d);
          EXPECT_EQ(p.triangles, ref.level(l).triangles) << m.name;
          double sd = 0;
          for (auto& [e, s] : ref.level(l).sharpness) { double o = sharpness_of(p, e.first, e.second); if (o != s) sd = std::max(sd, std::abs(o - s)); }
          EXPECT_EQ(p.sharpness.size(), ref.level(l).sharpness.size()) << m.name << l;
          EXPECT_LT(sd, 1e-6) << m.name;
        }
        double lim = -1;
        if (is_settled(m.mesh) && p.triangles.size() < 5000) { lim = largest_distance(limit_positions(p, derose98_rules()), ref.limit_positions()); }
        if (worst > 1e-9 || lim > 1e-9) std::printf("%d %d %-40s %.3g limit %.3g\n", int(decay), int(b), m.name.c_str(), worst, lim);
      }
}

}  // namespace
}  // namespace mesher::test

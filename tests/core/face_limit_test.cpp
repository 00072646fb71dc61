#include "engine/core/face_limit.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/core/error.h"

namespace mesher {
namespace {

std::string refusal_of(std::uint64_t faces, std::string_view subject = {}) {
  try {
    FaceLimit::check(faces, subject);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(FaceLimit, RefusesMoreFaces) {
  const FaceLimit limit(1000);
  EXPECT_EQ(refusal_of(1000), "");
  EXPECT_EQ(refusal_of(1001), "has 1,001 faces or more; --max-faces allows 1,000");
  EXPECT_EQ(refusal_of(5000, "the scene "),
            "the scene has 5,000 faces or more; --max-faces allows 1,000");
}

TEST(FaceLimit, WithoutOneAnyNumberIsAllowed) {
  { const FaceLimit limit(10); }
  EXPECT_EQ(refusal_of(~std::uint64_t{0}), "");
  const FaceLimit none(0);
  EXPECT_EQ(refusal_of(~std::uint64_t{0}), "");
}

}  // namespace
}  // namespace mesher

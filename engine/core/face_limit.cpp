#include "engine/core/face_limit.h"

#include <fmt/format.h>

#include <atomic>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/text.h"

namespace mesher {
namespace {

constexpr std::uint64_t kAnyNumber = std::numeric_limits<std::uint64_t>::max();
std::atomic<std::uint64_t> most_faces{kAnyNumber};

}  // namespace

FaceLimit::FaceLimit(std::uint64_t most) {
  most_faces = most > 0 ? most : kAnyNumber;
}

FaceLimit::~FaceLimit() {
  most_faces = kAnyNumber;
}

void FaceLimit::check(std::uint64_t faces, std::string_view subject) {
  const std::uint64_t most = most_faces.load(std::memory_order_relaxed);
  if (faces <= most) return;
  throw InputError(fmt::format("{}has {} or more; --max-faces allows {}", subject,
                               count_text(static_cast<std::int64_t>(faces), "face"),
                               count_text(static_cast<std::int64_t>(most))));
}

}  // namespace mesher

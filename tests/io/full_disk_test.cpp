// Writes every kind of file to a disk that is really full.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/pm_file.h"
#include "engine/io/png.h"
#include "engine/io/webp.h"
#include "engine/io/write.h"
#include "engine/progressive/build.h"
#include "tests/support/meshes.h"
#include "tests/support/small_disk.h"

namespace mesher {
namespace {

using test::SmallDisk;

/// Larger than the disk in every format.
Mesh large_mesh() {
  return build_mesh(test::torus(200, 100)).mesh;
}

/// Cannot be compressed.
Image noise() {
  Image image{.width = 256, .height = 256, .rgba = {}};
  std::uint32_t seed = 1;
  for (std::uint32_t i = 0; i < 4 * image.width * image.height; ++i) {
    seed = seed * 1664525U + 1013904223U;
    image.rgba.push_back(static_cast<std::uint8_t>(seed >> 24));
  }
  return image;
}

/// Expects that a write fails and says why, and that the old file stays the only one.
void expect_refusal(const SmallDisk& disk, const std::string& name,
                    const std::function<void(const std::filesystem::path&)>& write) {
  SCOPED_TRACE(name);
  const std::filesystem::path file = disk / name;
  std::ofstream(file) << "what was there before";
  for (const bool is_full : {false, true}) {
    if (is_full) disk.fill();
    try {
      write(file);
      ADD_FAILURE() << "was written";
    } catch (const OutputError& error) {
      EXPECT_EQ(std::string(error.what()),
                file.string() + ": cannot write: No space left on device");
    }
    EXPECT_EQ(test::read_bytes(file), "what was there before");
    EXPECT_EQ(disk.count_files(), 1U) << "no temporary file is left";
  }
  disk.make_room();
  std::filesystem::remove(file);
}

TEST(FullDisk, FailedModelsLeaveTheOldFile) {
  const Mesh mesh = large_mesh();
  const SmallDisk disk;
  std::size_t formats = 0;
  for (const io::FormatInfo& format : io::formats()) {
    if (format.write == nullptr) continue;
    ++formats;
    expect_refusal(disk, std::string("m") + format.extension,
                   [&](const auto& file) { io::write_model(file, mesh, {}); });
  }
  EXPECT_GE(formats, 6U);
}

TEST(FullDisk, FailedProgressiveMeshLeavesTheOldFile) {
  progressive::ProgressiveMesh levels = progressive::make_progressive(large_mesh(), {}).mesh;
  const SmallDisk disk(1U << 14);
  expect_refusal(disk, "m.pm", [&](const auto& name) {
    io::AtomicFile file(name);
    io::write_pm_file(file, levels, {});
    file.commit(io::Flush::now);
  });
}

TEST(FullDisk, FailedPicturesLeaveTheOldFile) {
  const Image image = noise();
  const SmallDisk disk;
  expect_refusal(disk, "p.png", [&](const auto& file) { io::write_png(file, image); });
  expect_refusal(disk, "p.webp", [&](const auto& file) { io::write_webp(file, image); });
  expect_refusal(disk, "turn.webp", [&](const auto& file) {
    io::WebpAnimation animation(file, image.width, image.height);
    animation.append(image, 0);
    animation.finish(100);
  });
}

TEST(FullDisk, FlushedFileIsThereOnceThereIsRoom) {
  const SmallDisk disk;
  disk.fill();
  const auto write = [&] {
    io::AtomicFile file(disk / "f");
    file.write("text");
    file.commit(io::Flush::now);
  };
  EXPECT_THROW(write(), OutputError);
  EXPECT_EQ(disk.count_files(), 0U);
  disk.make_room();
  write();
  EXPECT_EQ(test::read_bytes(disk / "f"), "text");
}

}  // namespace
}  // namespace mesher

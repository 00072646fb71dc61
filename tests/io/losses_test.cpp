#include "engine/io/losses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/io/format.h"
#include "engine/io/pm_file.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/progressive/build.h"
#include "tests/support/content_samples.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::content_samples;
using test::ContentSample;
using test::names_any;
using test::TempFolder;

/// Returns what a progressive mesh of a model holds.
FileContents pm_contents(const Model& model, const std::filesystem::path& name) {
  progressive::Progressive made =
      progressive::make_progressive(model.mesh, model.attributes, {.target_faces = 1});
  AtomicFile file(name);
  write_pm_file(file, made.mesh, {.attributes = &made.attributes}, model.materials.get());
  file.commit(Flush::later);
  return read_pm_file(name).contents;
}

// Kinds of content by formats: kept or named, no third case.
TEST(Losses, EveryKindIsKeptOrNamedInEveryFormat) {
  const TempFolder folder;
  for (const ContentSample& sample : content_samples()) {
    SCOPED_TRACE(std::string(key(sample.kind)) + " in " + sample.extension);
    const Model model = read_model(folder.write("in" + sample.extension, sample.bytes));
    ASSERT_GT(model.contents[sample.kind], 0U);
    for (const FormatInfo& format : formats()) {
      SCOPED_TRACE(format.extension);
      const auto file = folder / (std::string("out") + format.extension);
      const std::vector<std::string> losses = losses_in_format(
          file, model.mesh, model.attributes, model.materials.get(), model.contents, model.origin);
      const bool is_named = names_any(losses, sample.words);
      if (has_pm_ending(file)) {
        EXPECT_TRUE(is_named ||
                    pm_contents(model, file)[sample.kind] >= model.contents[sample.kind]);
        continue;
      }
      write_model(file, model.mesh, model.attributes,
                  {.origin = model.origin, .materials = model.materials});
      const bool is_kept = read_model(file).contents[sample.kind] >= model.contents[sample.kind];
      EXPECT_TRUE(is_kept || is_named);
    }
  }
}

TEST(Losses, SamplesCoverEveryKind) {
  const std::vector<ContentSample> all = content_samples();
  for (std::size_t i = 0; i < kContents.size(); ++i) {
    const auto kind = static_cast<Content>(i);
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const ContentSample& s) {
      return s.kind == kind;
    })) << key(kind);
  }
}

// A shape without anything else loses nothing, whatever the format.
TEST(Losses, PlainFilesLoseNothing) {
  const TempFolder folder;
  const Model model = read_model(folder.write("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  for (const FormatInfo& format : formats()) {
    const auto file = folder / (std::string("out") + format.extension);
    EXPECT_TRUE(losses_in_format(file, model.mesh, model.attributes, model.materials.get(),
                                 model.contents, model.origin)
                    .empty());
    if (format.write == nullptr) continue;
    write_model(file, model.mesh, model.attributes);
    const Model again = read_model(file);
    for (std::size_t i = 0; i < kContents.size(); ++i)
      EXPECT_EQ(again.contents[static_cast<Content>(i)], 0U) << format.extension;
  }
}

}  // namespace
}  // namespace mesher::io

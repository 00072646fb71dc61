#include "tests/support/zoo.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <set>
#include <string>

#include "engine/core/parallel.h"
#include "engine/mesh/build/report.h"
#include "tests/fuzz/support.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::Fate;
using test::read_or_refuse;
using test::Specimen;
using test::TempFolder;
using test::Watchdog;

/// A generous limit, because sanitizers slow the program down and machines differ.
constexpr std::chrono::seconds kSpecimenTimeLimit(120);
constexpr long kMostKilobytes = 3L << 20;

void examine(const Specimen& specimen) {
  SCOPED_TRACE(specimen.name);
  const TempFolder folder;
  const auto file = folder.write("specimen" + specimen.extension, specimen.bytes);
  const Watchdog watchdog(specimen.name, kSpecimenTimeLimit);
  std::string refusal;
  const std::optional<Model> model = read_or_refuse(file, &refusal);
  EXPECT_EQ(model.has_value(), specimen.fate == Fate::read) << refusal;
  EXPECT_EQ(folder.count_files(), 1U) << "reading must not create files";
  if (!model) return;
  if (specimen.faces) {
    EXPECT_EQ(model->mesh.face_count(), *specimen.faces);
  }
  for (const auto& [repair, count] : specimen.repairs) {
    EXPECT_EQ(model->report[repair], count) << describe(repair);
  }
}

void examine_all(void (*add)(std::vector<Specimen>&)) {
  std::vector<Specimen> specimens;
  add(specimens);
  for (const Specimen& specimen : specimens)
    examine(specimen);
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, kMostKilobytes)
      << "memory must be proportional to the file size, not to the counts in the file";
}

TEST(Zoo, ObjSyntaxIsReadOrRejected) {
  examine_all(test::add_obj_text);
}
TEST(Zoo, ObjShapesAreReadOrRejected) {
  examine_all(test::add_obj_shapes);
}
TEST(Zoo, PlyIsReadOrRejected) {
  examine_all(test::add_ply);
}
TEST(Zoo, StlAndOffAreReadOrRejected) {
  examine_all(test::add_stl_and_off);
}
TEST(Zoo, GltfIsReadOrRejected) {
  examine_all(test::add_gltf);
}

TEST(Zoo, Has60SpecimensWithUniqueNames) {
  std::set<std::string> names;
  for (const Specimen& specimen : test::zoo()) {
    EXPECT_TRUE(names.insert(specimen.name).second) << specimen.name;
  }
  EXPECT_GE(names.size(), 60U);
}

TEST(Zoo, EveryTruncationOfAValidFileIsReadOrRejected) {
  const ThreadLimit one(1);  // waking a second thread takes longer than reading a few hundred bytes
  for (const Specimen& sound : test::sound_files()) {
    SCOPED_TRACE(sound.name);
    const Watchdog watchdog(sound.name, kSpecimenTimeLimit);
    const TempFolder folder;
    for (std::size_t size = 0; size < sound.bytes.size(); ++size) {
      SCOPED_TRACE(size);
      read_or_refuse(folder.write("cut" + sound.extension, sound.bytes.substr(0, size)));
    }
    const auto whole = read_or_refuse(folder.write("whole" + sound.extension, sound.bytes));
    ASSERT_TRUE(whole.has_value());
    EXPECT_EQ(whole->mesh.face_count(), 2U);
    EXPECT_EQ(whole->mesh.vertex_count(), 4U);
  }
}

}  // namespace
}  // namespace mesher

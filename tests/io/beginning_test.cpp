#include "engine/io/beginning.h"

#include <gtest/gtest.h>

#include <string>

namespace mesher::io {
namespace {

TEST(FormatOfBeginning, KnowsEveryFormat) {
  EXPECT_EQ(format_of_beginning("\x89MPM\r\n\x1A\n...."), ".pm");
  EXPECT_EQ(format_of_beginning(std::string_view("glTF\2\0\0\0", 8)), ".glb");
  EXPECT_EQ(format_of_beginning(" \n{\"asset\":{}}"), ".gltf");
  EXPECT_EQ(format_of_beginning("{ \"asset\""), ".gltf");
  EXPECT_EQ(format_of_beginning("ply\nformat ascii 1.0\n"), ".ply");
  EXPECT_EQ(format_of_beginning("ply\r\nformat"), ".ply");
  EXPECT_EQ(format_of_beginning("solid name\nfacet"), ".stl");
  for (const char* off : {"OFF\n8 6 0", "# by hand\nCOFF 1 2 3", "STCN4nOFF 1", "NOFF"})
    EXPECT_EQ(format_of_beginning(off), ".off") << off;
  for (const char* obj : {"v 0 0 0", "# words\n\n# more\r\nmtllib x", "g", "vn 0 0 1", "o Cube",
                          "\xEF\xBB\xBFv 1 2 3"})
    EXPECT_EQ(format_of_beginning(obj), ".obj") << obj;
}

TEST(FormatOfBeginning, BinaryStlIsNoTextAndHasFiniteNumbers) {
  std::string bytes(84 + 50, '\0');
  bytes[80] = 1;
  EXPECT_EQ(format_of_beginning(bytes), ".stl");
  EXPECT_EQ(format_of_beginning("solid " + bytes.substr(6)), ".stl");
  bytes.replace(84, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_EQ(format_of_beginning(bytes), "");
  EXPECT_EQ(format_of_beginning(std::string(83, '\0')), "");
  EXPECT_EQ(format_of_beginning(std::string(4096, '\0')), "") << "no facets";
}

TEST(FormatOfBeginning, DoesNotGuess) {
  for (const char* other :
       {"", "# only a comment", "hello", "\x89PNG\r\n\x1A\n", "<html>", "OFFER", "plywood"})
    EXPECT_EQ(format_of_beginning(other), "") << other;
}

}  // namespace
}  // namespace mesher::io

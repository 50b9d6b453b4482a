#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "reflines/errors.h"
#include "reflines/subdivision.h"
#include "tests/native/geometry/cages.h"

namespace reflines {
namespace {

// The sentence with which `change` of a good cage or of good options is refused; empty when it is not.
std::string refusal(const std::function<void(Cage*, SubdivisionOptions*)>& change) {
  Cage cage = cube().cage;
  add_crease(&cage, 0, 1, 2);
  SubdivisionOptions options;
  change(&cage, &options);
  try {
    subdivide(cage, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

void expect_said(const std::string& sentence, const std::string& what) {
  EXPECT_NE(sentence.find(what), std::string::npos) << "'" << sentence << "'";
  EXPECT_NE(sentence.find(": "), std::string::npos) << "no advice in '" << sentence << "'";
}

TEST(SubdivisionInput, TheUnchangedCageIsAccepted) {
  EXPECT_EQ(refusal([](Cage*, SubdivisionOptions*) {}), "");
}

TEST(SubdivisionInput, LevelsOutsideOneToSixAreRefused) {
  for (const int level : {-1, 0, 7}) {
    expect_said(refusal([&](Cage*, SubdivisionOptions* options) { options->level = level; }), std::to_string(level));
  }
}

TEST(SubdivisionInput, TooManyFacesAreRefusedBeforeTheyAreMade) {
  const auto grow = [](Cage* cage, SubdivisionOptions* options) {
    *cage = grid(100, 100).cage;
    options->level = 6;
  };
  expect_said(refusal(grow), "40 million faces");
}

TEST(SubdivisionInput, FacesMustBePolygonsOfTheCage) {
  expect_said(refusal([](Cage* cage, auto*) { *cage = polygons(4, {}); }), "no face");
  expect_said(refusal([](Cage* cage, auto*) { *cage = polygons(4, {{0, 1, 2}, {2, 3}}); }), "the first is face 1");
  expect_said(refusal([](Cage* cage, auto*) { cage->face_vertices[5] = 8; }), "names vertex 8");
  expect_said(refusal([](Cage* cage, auto*) { cage->face_vertices[5] = -1; }), "names vertex -1");
  expect_said(refusal([](Cage* cage, auto*) { cage->face_vertices[1] = 0; }), "uses vertex 0 twice");
  expect_said(refusal([](Cage* cage, auto*) { cage->face_offsets[6] = 99; }), "to 99");
  expect_said(refusal([](Cage* cage, auto*) { cage->face_offsets[2] = 99; }), "fewer than 3");
  const auto overflow = [](Cage* cage, auto*) {  // each difference is 3 or more modulo 2^32
    *cage = polygons(4, {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}});
    cage->face_offsets << 0, 2147483647, -2147483646, -1000, 12;
  };
  expect_said(refusal(overflow), "the first is face 1");
}

TEST(SubdivisionInput, LoopNeedsTriangles) {
  const auto loop = [](Cage*, SubdivisionOptions* options) { options->scheme = SubdivisionScheme::kLoop; };
  expect_said(refusal(loop), "6 faces");
}

TEST(SubdivisionInput, CreasesAreEdgesWithASharpness) {
  expect_said(refusal([](Cage* cage, auto*) { add_crease(cage, 0, 7, 1); }), "no edge");
  expect_said(refusal([](Cage* cage, auto*) { add_crease(cage, 0, 99, 1); }), "no edge");
  expect_said(refusal([](Cage* cage, auto*) { cage->crease_sharpness[0] = -1; }), "-1");
  expect_said(refusal([](Cage* cage, auto*) { cage->crease_sharpness[0] = std::nan(""); }), "nan");
  expect_said(refusal([](Cage* cage, auto*) { cage->crease_sharpness.resize(0); }), "1 crease");
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal([&](Cage* cage, auto*) { cage->crease_sharpness[0] = infinite; }), "");
}

TEST(SubdivisionInput, CornersAreVerticesWithASharpness) {
  const auto corner = [](int vertex, double sharpness) {
    return [=](Cage* cage, auto*) {
      cage->corners = IndexVector::Constant(1, vertex);
      cage->corner_sharpness = Vector::Constant(1, sharpness);
    };
  };
  EXPECT_EQ(refusal(corner(7, 3)), "");
  expect_said(refusal(corner(8, 3)), "names vertex 8");
  expect_said(refusal(corner(7, std::nan(""))), "nan");
}

}  // namespace
}  // namespace reflines

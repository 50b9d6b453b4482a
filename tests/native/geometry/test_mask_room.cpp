#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include "geometry/mask_room.h"
#include "reflines/errors.h"
#include "reflines/subdivision.h"
#include "tests/native/geometry/cages.h"

namespace reflines {
namespace {

// Triangles that share the edge 0-1, and a face with so many corners beside them.
Cage book(int pages, int corners = 0) {
  std::vector<std::vector<int>> faces;
  for (int page = 0; page < pages; ++page) faces.push_back({0, 1, 2 + page});
  std::vector<int> face(corners);
  std::iota(face.begin(), face.end(), 2 + pages);
  if (corners > 0) faces.push_back(face);
  return polygons(2 + pages + corners, faces);
}

// Random faces of 3 to 5 corners over few vertices: most of their edges have many faces.
Cage tangle(int seed) {
  std::mt19937 random(seed);
  const int vertices = 5 + static_cast<int>(random() % 12), count = 1 + static_cast<int>(random() % 40);
  std::vector<std::vector<int>> faces;
  for (int f = 0; f < count; ++f) {
    std::vector<int> face(vertices);
    std::iota(face.begin(), face.end(), 0);
    std::shuffle(face.begin(), face.end(), random);
    face.resize(3 + random() % 3);
    faces.push_back(face);
  }
  return polygons(vertices, faces);
}

std::string refusal(const Cage& cage) {
  try {
    check_mask_room(cage);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(MaskRoom, AnEdgeHasRoomForEightFaces) {
  EXPECT_EQ(refusal(book(8)), "");
  EXPECT_EQ(refusal(book(9)),
            "9 faces of the cage share the edge between the vertices 0 and 1, too many to be subdivided: delete the "
            "inner ones until at most two share an edge.");
}

TEST(MaskRoom, AnEdgeHasAsMuchRoomAsTheVertexOfMostEdges) {
  EXPECT_EQ(refusal(book(20, 40)), "");
  EXPECT_NE(refusal(book(21, 40)), "");
}

TEST(MaskRoom, AVertexHasRoomForSixteenFacesMoreThanEdges) {
  // Every triangle round vertex 0 on 6 others: 15 faces on 6 edges, each of which has 5 faces; then three of them
  // twice.
  std::vector<std::vector<int>> faces;
  for (int a = 1; a <= 6; ++a) {
    for (int b = a + 1; b <= 6; ++b) faces.push_back({0, a, b});
  }
  EXPECT_EQ(refusal(polygons(7, faces)), "");
  for (const std::vector<int>& face : {std::vector{0, 1, 2}, {0, 3, 4}}) faces.push_back(face);
  EXPECT_NE(refusal(polygons(7, faces)).find("17 faces of the cage, but only 6 edges, meet at vertex 0"),
            std::string::npos);
}

TEST(MaskRoom, ManifoldCagesAlwaysHaveRoom) {
  EXPECT_EQ(refusal(cube().cage), "");
  EXPECT_EQ(refusal(star(200, 2).cage), "");
  EXPECT_EQ(refusal(grid(3, 4).cage), "");
}

// The sanitizers watch the buffers; here a mask that another one overwrote would show in its sum.
TEST(MaskRoom, WhatHasRoomIsSubdividedAsItShould) {
  int accepted = 0;
  for (int seed = 0; seed < 400; ++seed) {
    const Cage cage = tangle(seed);
    SubdivisionOptions options;
    options.level = 1 + seed % 3;
    if (!refusal(cage).empty()) {
      EXPECT_THROW(subdivide(cage, options), InvalidInput);
      continue;
    }
    ++accepted;
    const Subdivision result = subdivide(cage, options);
    const Vector ones = Vector::Ones(cage.vertices);
    EXPECT_LT((result.positions * ones - Vector::Ones(result.positions.rows())).cwiseAbs().maxCoeff(), 1e-12) << seed;
    EXPECT_LT((result.tangent_u * ones).cwiseAbs().maxCoeff(), 1e-9) << seed;
    EXPECT_LT((result.tangent_v * ones).cwiseAbs().maxCoeff(), 1e-9) << seed;
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 350);
}

}  // namespace
}  // namespace reflines

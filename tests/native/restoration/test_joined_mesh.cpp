#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "restoration/joined_mesh.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

// A mesh of which some triangles are the region, and the vertices' names in the whole one.
struct Divided {
  Positions V;
  Triangles F;
  Surroundings around;
  std::vector<int> own, others;
};

// Divides a mesh into the ring of triangles with centres at most `width` within the square of half size 0.4, and the
// rest.
Divided divide(const samples::Mesh& mesh, double width) {
  Divided result;
  std::vector<int> ring, rest, number(mesh.V.rows(), -1);
  for (int t = 0; t < mesh.F.rows(); ++t) {
    const Eigen::RowVector3d centre =
        (mesh.V.row(mesh.F(t, 0)) + mesh.V.row(mesh.F(t, 1)) + mesh.V.row(mesh.F(t, 2))) / 3;
    const double out = std::max(std::abs(centre.x() - 0.5), std::abs(centre.y() - 0.5));
    (out < 0.4 && out > 0.4 - width ? ring : rest).push_back(t);
  }
  std::set<int> used;
  for (const int t : ring) used.insert({mesh.F(t, 0), mesh.F(t, 1), mesh.F(t, 2)});
  result.own.assign(used.begin(), used.end());
  for (int v = 0; v < mesh.V.rows(); ++v) {
    if (!used.count(v)) result.others.push_back(v);
  }
  int count = 0;
  for (const std::vector<int>* list : {&result.own, &result.others}) {
    for (const int v : *list) number[v] = count++;
  }
  const Triangles renumbered = mesh.F.unaryExpr([&](int v) { return number[v]; });
  result.V = mesh.V(result.own, Eigen::all);
  result.F = renumbered(ring, Eigen::all);
  result.around = {mesh.V(result.others, Eigen::all), renumbered(rest, Eigen::all)};
  return result;
}

TEST(JoinedMesh, HasTheTrianglesNearTheBorder) {
  const auto mesh =
      samples::lifted(samples::grid(40, 0.3), [](double x, double y) { return 0.2 * std::sin(5 * x * y); });
  const Divided parts = divide(mesh, 0.1);
  for (const double reach : {0.01, 0.06, 0.2, 3.0}) {
    int near = 0;
    const auto is_near = [&](int v) {
      if (v < parts.V.rows()) return true;
      double squared = INFINITY;  // to all vertices of the region: those inside it are no nearer than its border
      for (Eigen::Index k = 0; k < parts.V.rows(); ++k)
        squared = std::min(squared, (parts.V.row(k) - parts.around.V.row(v - parts.V.rows())).squaredNorm());
      return squared < reach * reach;
    };
    for (const auto& triangle : parts.around.F.rowwise())
      near += is_near(triangle(0)) || is_near(triangle(1)) || is_near(triangle(2));
    const JoinedMesh joined = join_surroundings(parts.V, parts.F, parts.around, reach);
    EXPECT_EQ(joined.F.rows(), parts.F.rows() + near);
    EXPECT_EQ(joined.F.topRows(parts.F.rows()), parts.F);
    EXPECT_EQ(joined.V.topRows(parts.V.rows()), parts.V);
    EXPECT_EQ(joined.F.maxCoeff() + 1, joined.V.rows());
  }
}

// The border's vertices stand in a tree: a vertex beside the region is compared with two of 5,600 in the mean.
TEST(JoinedMesh, OfARingComparesFewVertices) {
  const Divided parts = divide(samples::grid(600), 0.02);
  const JoinedMesh joined = join_surroundings(parts.V, parts.F, parts.around, 0.02);
  EXPECT_GT(joined.F.rows(), parts.F.rows());
  EXPECT_LT(joined.compared, 5 * parts.around.V.rows());
}

}  // namespace
}  // namespace reflines

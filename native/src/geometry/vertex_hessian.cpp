#include "geometry/vertex_hessian.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/sort_unique.h"

namespace reflines {
namespace {

// Returns the gradients of the barycentric coordinates of a triangle, a row a corner.
Eigen::Matrix<double, 3, 2> barycentric_gradients(const PlanePositions& xy, const Triangles& F, int t) {
  const Vector2 a = xy.row(F(t, 0)), b = xy.row(F(t, 1)), c = xy.row(F(t, 2));
  const Vector2 opposite[3] = {c - b, a - c, b - a};
  const double doubled = opposite[0].x() * opposite[1].y() - opposite[0].y() * opposite[1].x();
  Eigen::Matrix<double, 3, 2> result;
  for (int i = 0; i < 3; ++i) result.row(i) << -opposite[i].y() / doubled, opposite[i].x() / doubled;
  return result;
}

// Subtracts the normal derivative in the triangle beyond the edge.
void subtract_far_side(const PlanePositions& xy, const Triangles& F, int other, const Vector2& normal, EdgeJump& edge) {
  const Eigen::Matrix<double, 3, 2> far = barycentric_gradients(xy, F, other);
  for (int k = 0; k < 3; ++k) {
    const double part = far.row(k).dot(normal);
    if (F(other, k) == edge.vertex[1]) {
      edge.weight[1] -= part;
    } else if (F(other, k) == edge.vertex[2]) {
      edge.weight[2] -= part;
    } else {
      edge.vertex[3] = F(other, k);
      edge.weight[3] = -part;
    }
  }
}

// Returns the edge opposite corner i of triangle t; its length is 0 where it has none.
EdgeJump make_edge_jump(const PlanePositions& xy, const Triangles& F, const Vector& area, int t, int i, int other) {
  const int a = F(t, (i + 1) % 3), b = F(t, (i + 2) % 3);
  const Vector2 along = (xy.row(b) - xy.row(a)).transpose();
  const double both = area(t) + area(other), length = along.norm();
  EdgeJump edge{{F(t, i), a, b, 0}, {}, Vector3::Zero(), length, 0.0};
  if (!(length > 0)) return edge;
  Vector2 normal = Vector2(-along.y(), along.x()) / length;
  if (normal.dot((xy.row(F(t, i)) - xy.row(a)).transpose()) < 0) normal = -normal;  // towards t
  edge.across << normal.x() * normal.x(), std::numbers::sqrt2 * normal.x() * normal.y(), normal.y() * normal.y();
  edge.distance = 2.0 / 3.0 * both / length;
  const Eigen::Matrix<double, 3, 2> own = barycentric_gradients(xy, F, t);
  for (int k = 0; k < 3; ++k) edge.weight[k] = own.row((i + k) % 3).dot(normal);
  subtract_far_side(xy, F, other, normal, edge);
  return edge;
}

PatchWeights sum_jumps(const VertexPatch& patch, const std::vector<EdgeJump>& edges, const Vector& trust) {
  PatchWeights result = PatchWeights::Zero(3, static_cast<Eigen::Index>(patch.vertex.size()));
  for (const VertexPatch::Edge& own : patch.edges) {
    const EdgeJump& edge = edges[own.edge];
    const double weight = trust.size() > 0 ? std::sqrt(trust(own.edge)) : 1.0;
    const Vector3 half = 0.5 * edge.length * weight * edge.across;
    for (int i = 0; i < 4; ++i) result.col(own.place[i]) += edge.weight[i] * half;
  }
  return result;
}

// The least eigenvalue of a mass, of a third of the area around the vertex: where neighbours are no Delaunay triangles
// D_v of a quadratic may be 0 or less.
constexpr double kLeastMass = 0.7;

// Returns M_v^-1/2 from D_v of the quadratics with unit Hessians; `area` is a third of that around the vertex.
Eigen::Matrix3d find_inverse_root(const VertexPatch& patch, const std::vector<EdgeJump>& edges,
                                  const PlanePositions& xy, double area) {
  const PatchWeights weight = sum_jumps(patch, edges, {});
  Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < weight.cols(); ++i) {
    const Vector2 p = (xy.row(patch.vertex[i]) - xy.row(patch.center)).transpose();
    mass += weight.col(i) * Vector3(p.x() * p.x(), std::numbers::sqrt2 * p.x() * p.y(), p.y() * p.y()).transpose() / 2;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(0.5 * (mass + mass.transpose()));
  const Vector3 root = eigen.eigenvalues().cwiseMax(kLeastMass * area).cwiseSqrt();
  return eigen.eigenvectors() * root.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
}

VertexPatch make_patch(const std::vector<EdgeJump>& all, const std::vector<int>& edges, int center) {
  VertexPatch patch{center, Eigen::Matrix3d::Identity(), {}, {}};
  for (const int e : edges) patch.vertex.insert(patch.vertex.end(), all[e].vertex, all[e].vertex + 4);
  sort_unique(patch.vertex);
  for (const int e : edges) {
    VertexPatch::Edge own{e, {}};
    for (int i = 0; i < 4; ++i) {
      const auto place = std::lower_bound(patch.vertex.begin(), patch.vertex.end(), all[e].vertex[i]);
      own.place[i] = static_cast<int>(place - patch.vertex.begin());
    }
    patch.edges.push_back(own);
  }
  return patch;
}

}  // namespace

std::vector<EdgeJump> list_edge_jumps(const PlanePositions& xy, const Triangles& F, const Triangles& neighbors,
                                      const Vector& area) {
  std::vector<EdgeJump> edges;
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int other = neighbors(t, i);
      if (other < t || area(t) <= 0 || area(other) <= 0) continue;
      const EdgeJump edge = make_edge_jump(xy, F, area, t, i, other);
      if (edge.length > 0) edges.push_back(edge);
    }
  }
  return edges;
}

std::vector<VertexPatch> gather_patches(const std::vector<EdgeJump>& edges, const PlanePositions& xy,
                                        const Triangles& F, const Vector& area) {
  std::vector<std::vector<int>> at_vertex(xy.rows());
  for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
    for (const int end : {edges[e].vertex[1], edges[e].vertex[2]}) at_vertex[end].push_back(e);
  }
  Vector third = Vector::Zero(xy.rows());
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) third(F(t, i)) += area(t) / 3.0;
  }
  std::vector<VertexPatch> patches;
  for (int v = 0; v < xy.rows(); ++v) {
    const std::vector<int>& own = at_vertex[v];
    if (own.empty()) continue;
    if (static_cast<int>(own.size()) <= kMostPatchEdges) {
      patches.push_back(make_patch(edges, own, v));
      patches.back().inverse_root = find_inverse_root(patches.back(), edges, xy, third(v));
    } else {
      for (const int e : own) {
        patches.push_back(make_patch(edges, {e}, v));
        patches.back().inverse_root *= std::sqrt(static_cast<double>(own.size()) / third(v));
      }
    }
  }
  return patches;
}

PatchWeights weigh_patch(const VertexPatch& patch, const std::vector<EdgeJump>& edges, const Vector& trust) {
  return patch.inverse_root * sum_jumps(patch, edges, trust);
}

}  // namespace reflines

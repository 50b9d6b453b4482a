// Smoothing of the lines' field that keeps its creases: the second-order smoother of a vertex field with iteratively
// reweighted least squares (IRLS; Geman-McClure weights, Black & Rangarajan 1996) on the jumps of its normal
// derivative.
#pragma once

#include <memory>
#include <vector>

#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// One row a triangle, one column a component of the lines' field: 2 for each family of lights.
using TriangleFields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The smoothed field U lives at the vertices and minimises
//   sum_T A_T |mean of U over T - g_T|^2 + l^4 sum_v A_v |H_v|^2,
//   H_v = (1 / A_v) sum_{e at v} sqrt(w_e) |e| / 2 (jump of dU/dn across e) n n^T,
// l = length / 2 pi. Without weights H_v is the Hessian of the mixed finite element method (Stein, Grinspun, Wardetzky
// and Jacobson 2018): a wave of wavelength w keeps 1 / (1 + (length / w)^4) of its amplitude in any direction on any
// mesh, 0.5 at w = length, measured 0.43 to 0.50 on regular, 4-8, random and stretched ones. (The sum of squared jumps,
// which is cheaper, keeps 0.02 to 0.49.) It vanishes for linear fields, at the border too. Where a design changes its
// curvature along a line (a fillet's edge, a character line), the jumps are many times the median; their weight w_e
// falls to nothing, and the field is smoothed on both sides of the line but not across it.
struct SmootherOptions {
  // Times the median jump, to which each edge counts by the square root of its triangles' area: jumps of this size have
  // a quarter of the full weight. Were edges only counted, features, which have most of them, would set the scale: the
  // harm to 26 clean panels was 0.20 / 0.21 degrees in the median instead of 0.18 / 0.17 with the same jump of 2. By
  // the area itself it is 0.17 / 0.16, but less of ripples and dents goes.
  double crease_jump;
  int rounds;  // of reweighting; the weights settle to 2 % within six
};

class CreasePreservingSmoother {
 public:
  // xy (#V x 2), F (#F x 3), area (#F, projected; triangles of area 0 are left out). `length` > 0, in units of xy.
  CreasePreservingSmoother(const PlanePositions& xy, const Triangles& F, const Vector& area, double length,
                           const SmootherOptions& options);
  CreasePreservingSmoother(const CreasePreservingSmoother&) = delete;
  ~CreasePreservingSmoother();

  // Finds the weights w_e (#inner edges) for g (#F x m). `start`, weights of a field that is nearly g, is where the
  // iteration begins; it may be empty. `progress` may be null; throws Cancelled.
  Vector find_creases(const TriangleFields& g, Progress* progress, const Vector& start = {}) const;

  // Smooths g (#F x m) with these weights, up to `stretch` times the length. Returns means (#F x m) of U over
  // triangles, g itself where the area is 0.
  TriangleFields smooth_with(const Vector& creases, const TriangleFields& g, double stretch = 1.0) const;

 private:
  // An inner edge: its four vertices, how the normal derivative of a P1 field jumps across it, the tensor n n^T of its
  // normal, its length, and the distance of the two centroids, which makes a second derivative of the jump.
  struct Edge {
    int vertex[4];
    double jump[4];
    Vector3 across;  // n_x^2, sqrt(2) n_x n_y, n_y^2: the norm is that of the tensor
    double length, distance;
  };
  struct PatchEdge {
    int edge;
    int place[4];  // of its vertices among those of the patch
  };
  // A vertex's edges, the vertices that their jumps couple (ascending), where the lower triangle of the products of
  // these adds up in the values, and a third of the area around it.
  struct Patch {
    std::vector<PatchEdge> edges;
    std::vector<int> vertex, entries;
    double area;
  };
  // The number of edges at a vertex up to which they are taken together. Those of others, as at the tip of a cone,
  // count one by one: the products of a thousand edges with each other would fill the matrix.
  static constexpr int kMostEdges = 22, kMostPatchVertices = 1 + 3 * kMostEdges;
  using PatchWeights = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMostPatchVertices>;
  void gather_patches(int vertex_count);
  void add_patch(const std::vector<int>& edges, double area);
  PatchWeights sum_jumps(const Patch& patch, const Vector& trust) const;
  void add_edges(const PlanePositions& xy, const Triangles& F, const Vector& area);
  void build_pattern(int vertex_count);
  void assemble(const Vector& trust, double stiffness, SparseMatrix& A) const;
  class System;
  TriangleFields mean_over_triangles(const TriangleFields& U, const TriangleFields& g) const;
  Vector measure_jumps(const TriangleFields& U) const;
  TriangleFields right_hand_side(const TriangleFields& g) const;

  double stiffness_;  // l^4
  SmootherOptions options_;
  Triangles F_;
  Vector area_, corner_;  // #F; #V: what keeps vertices without data and isolated triangles determined
  std::vector<Edge> edges_;
  Vector edge_size_;      // #inner edges: proportional to the square root of the area of their two triangles
  SparseMatrix pattern_;  // lower triangle, values zero
  std::vector<int> triangle_entries_;  // where their products add up in the values
  std::vector<Patch> patches_;
  std::unique_ptr<System> system_;  // refers to *this
};

}  // namespace reflines

// Smoothing of the lines' field that keeps its creases: the second-order smoother of a vertex field with iteratively
// reweighted least squares (IRLS; Geman-McClure weights, Black & Rangarajan 1996) on the jumps of its normal
// derivative.
#pragma once

#include <memory>
#include <vector>

#include "geometry/vertex_hessian.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// One row a triangle, one column a component of the lines' field: 2 for each family of lights.
using TriangleFields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The smoothed field U lives at the vertices and minimises
//   sum_T A_T |mean of U over T - g_T|^2 + l^4 E(U),   l = length / 2 pi,
// where E is the thin-plate energy (see vertex_hessian.h), in which the jump across an edge counts by the square root
// of the edge's weight w_e. Without weights a wave of wavelength w keeps 1 / (1 + (length / w)^4) of its amplitude in
// any direction on any mesh, 0.5 at w = length. (A sum of squared jumps, which is cheaper, keeps 0.02 to 0.49.) Where a
// design changes its curvature along a line (a fillet's edge, a character line), the jumps are many times the median;
// their weight w_e falls to nothing, and the field is smoothed on both sides of the line but not across it.
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
  std::vector<EdgeJump> edges_;
  Vector edge_size_;      // #inner edges: proportional to the square root of the area of their two triangles
  SparseMatrix pattern_;  // lower triangle, values zero
  std::vector<int> triangle_entries_;  // where their products add up in the values
  std::vector<VertexPatch> patches_;
  std::vector<std::vector<int>> patch_entries_;  // likewise, of the lower triangle of each patch's products
  std::unique_ptr<System> system_;               // refers to *this
};

}  // namespace reflines

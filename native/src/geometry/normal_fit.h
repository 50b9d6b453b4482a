// Vertex normals for display: the tangent plane of a quadratic fitted to the surface around each vertex (paper, section
// 3, "Discretizing normals").
#pragma once

#include <vector>

#include "geometry/mesh.h"
#include "reflines/types.h"

namespace reflines {

// The fits around all vertices: over the triangles around a vertex and those sharing an edge with them, in the plane of
// an initial normal, with minimum-norm coefficients. Unlike in the paper, vertices are weighted by the area around
// them, and hardly count where they face far away from the vertex of the fit: where a panel is folded into a hem of
// thin triangles, its own lines run straight to the edge. The 2 x K coefficients of each vertex are kept: new positions
// give new normals by a small product, and a vertex is fitted anew only when its normal has turned by more than
// refit_angle since its last fit.
class NormalFit {
 public:
  // V (#V x 3), F (#F x 3); refit_angle in radians. Throws InvalidInput for indices out of range.
  NormalFit(const Positions& V, const Triangles& F, double refit_angle = 0.35);

  // Returns #V x 3 unit normals on the side that the triangles face; (0, 0, 1) for vertices without triangles.
  Positions normals(const Positions& V);

  // Returns the normals by the present fits without refitting any, so that nothing is changed.
  Positions kept_normals(const Positions& V) const;

  int refit_count() const { return refit_count_; }  // vertices fitted anew since construction

 private:
  struct Fit {
    Vector3 e1, e2, initial;                          // frame of the fit
    Vector3 fitted;                                   // the normal when the fit was made
    Eigen::Matrix<double, 2, Eigen::Dynamic> slopes;  // weights of the K heights over the frame's plane
  };
  void check_count(const Positions& V) const;
  void fit(const Positions& V, const Positions& area_normals, int v);
  Vector3 normal(const Positions& V, int v) const;

  Triangles F_;
  Incidence triangles_of_vertex_;
  Incidence stencil_;  // for each vertex the K vertices of its fit, itself first
  std::vector<Fit> fits_;
  double cosine_;
  int refit_count_ = 0;
};

}  // namespace reflines

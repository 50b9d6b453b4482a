// The thin-plate energy of a piecewise linear (P1) field by the mixed finite element method (Stein, Grinspun, Wardetzky
// and Jacobson 2018, "Natural boundary conditions for smoothing in geometry processing"), with a lumped mass of our
// own:
//   E = sum_v D_v^T M_v^-1 D_v,   D_v = sum_{inner edges e at v} |e| / 2 (jump of dU/dn across e) n n^T.
// D_v is the integral of the distributional Hessian times the hat function at v. It vanishes for linear fields, at the
// border too, and is conservative: the sum of D_v : Phi_v is that of U times the second derivatives of Phi, up to
// second order, on any mesh. M_v (3 x 3, of the components xx, sqrt(2) xy, yy) is what makes M_v^-1 D_v exact on
// quadratics: D_v of the three unit quadratics, made symmetric. With a third of the area around v in its place, as is
// usual, E of a quadratic is 24 % too large on a 4-8 mesh, however fine.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// An edge between two triangles, and how the normal derivative of a P1 field jumps across it.
struct EdgeJump {
  int vertex[4];     // the corner opposite in one triangle, the edge's two ends, the corner opposite in the other
  double weight[4];  // of the field at these vertices
  Vector3 across;    // n_x^2, sqrt(2) n_x n_y, n_y^2 of the edge's normal: its norm is that of the tensor
  double length;
  double distance;  // of the two centroids across the edge; jump / distance is a second derivative
};

// The edges whose jumps make one vertex's D_v.
struct VertexPatch {
  struct Edge {
    int edge;
    int place[4];  // of its vertices among those of the patch
  };
  int center;                    // the vertex v
  Eigen::Matrix3d inverse_root;  // M_v^-1/2
  std::vector<int> vertex;       // ascending
  std::vector<Edge> edges;
};

// The number of edges at a vertex up to which they make one patch. Others, as at the tip of a cone, make one each: the
// products of a thousand edges with each other would fill a matrix.
constexpr int kMostPatchEdges = 22;

// #patch vertices columns: the weights of the components xx, sqrt(2) xy and yy.
using PatchWeights = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 1 + 3 * kMostPatchEdges>;

// Lists the edges that two triangles of positive area have in common, by triangle. xy (#V x 2), F and `neighbors` (#T x
// 3, see edge_neighbors; -1 ends the field there), area (#T, projected; triangles of area 0 are left out).
std::vector<EdgeJump> list_edge_jumps(const PlanePositions& xy, const Triangles& F, const Triangles& neighbors,
                                      const Vector& area);

// Gathers the patches of the vertices with inner edges, in ascending order of the vertices.
std::vector<VertexPatch> gather_patches(const std::vector<EdgeJump>& edges, const PlanePositions& xy,
                                        const Triangles& F, const Vector& area);

// Returns M_v^-1/2 D_v, whose squared norm is the patch's part of E. Each jump counts times the square root of its
// edge's `trust` (#edges; empty: 1).
PatchWeights weigh_patch(const VertexPatch& patch, const std::vector<EdgeJump>& edges, const Vector& trust);

}  // namespace reflines

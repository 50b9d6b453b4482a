// A region of a mesh as height fields over the image plane: the triangles that face the viewer, the role of each
// vertex, and the pieces of coupled triangles (paper, section 3).
#pragma once

#include <vector>

#include "geometry/crease.h"
#include "geometry/mesh.h"
#include "reflines/border.h"
#include "reflines/image_plane.h"
#include "reflines/types.h"

namespace reflines {

// The role of a vertex in a solve.
enum class VertexRole : signed char {
  kUnused,   // touches no triangle of a height-field piece
  kFree,     // moves along the view
  kFixed,    // stays, because of a border, a silhouette or the caller's mask
  kClamped,  // stays because a clamped border vertex is one edge away
};

struct Boundary {
  std::vector<Border> border;  // #V, read at border vertices only
  Mask held;                   // #V, or empty: vertices that stay whatever the border says
  CreaseOptions creases;
  bool hold_creases = true;  // false: no stencil reaches across a crease, but its vertices may move
};

// The |n.v| of a unit normal n below which a triangle is a silhouette, seen at less than 12 degrees: there a move along
// the view slides the surface five times as far as it lifts it.
constexpr double kSilhouette = 0.2;

// The triangles of a region that face the viewer, over the image plane. Coordinates and heights are relative to the
// region's centroid; RegionPieces converts them to the world's origin, which all public ones have. With heights from
// the world's origin a panel 1,000 times its size away took 100 steps and did not converge, where 3 suffice.
struct HeightField {
  Triangles F;              // #T x 3: the triangles that face the viewer, indices into the region's vertices
  std::vector<int> source;  // #T: index of each one among the triangles of the region
  Triangles neighbors;      // #T x 3: the one across the edge opposite each corner, or -1; also -1 across a crease
  Vector area;              // #T: projected area, > 0
  PlanePositions xy;        // #V x 2, relative to the region's centroid
  Vector z;                 // #V, relative to the region's centroid
  Incidence triangles_of_vertex;  // among F
  std::vector<VertexRole> role;   // #V
  std::vector<int> piece;         // #T: 0 .. piece_count - 1
  int piece_count = 0;
  Mask silhouette;       // of the region's triangles: left out, |n.v| < kSilhouette
  Mask turned_away;      // of the region's triangles: left out, n.v <= -kSilhouette, turned away or folded over
  int crease_count = 0;  // edges that are creases
  int marked_count = 0;  // marked edges among the creases
  bool closed = false;   // the region has no border edge

  int vertex_count() const { return static_cast<int>(xy.rows()); }
  int triangle_count() const { return static_cast<int>(F.rows()); }
  bool has_free_vertex(int t) const;
  double diagonal() const;         // diagonal of the used vertices' bounding box in the image plane
  Vector piece_diagonals() const;  // #pieces, likewise
  double piece_diagonal() const { return piece_diagonals().maxCoeff(); }
};

// Splits a checked region (see check_surface) at its silhouettes and creases (see crease_edges). Vertices of excluded
// triangles and of creases are fixed. Pieces are coupled sets: triangles with a common edge or any other common vertex
// belong to one piece. Throws InvalidInput where no triangle faces the viewer.
HeightField make_height_field(const Positions& V, const Triangles& F, const ImagePlane& frame,
                              const Boundary& boundary);

}  // namespace reflines

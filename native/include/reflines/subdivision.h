// Subdivision surfaces as matrices: refined or limit positions and limit tangents of a cage, each a sparse matrix times
// the cage's vertices, by OpenSubdiv. The rules are those of Blender's Subdivision Surface modifier.
#pragma once

#include "reflines/cage.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

enum class SubdivisionScheme {
  kCatmullClark,  // any polygons
  kLoop,          // triangles only
};

// The rule for the border; the values are those of the modifier's option Boundary Smooth.
enum class SubdivisionBoundary {
  kAll,              // the border is a smooth curve through its corners, too
  kPreserveCorners,  // vertices of a single face stay where they are
};

inline constexpr int kMaxSubdivisionLevel = 6;

struct SubdivisionOptions {
  SubdivisionScheme scheme = SubdivisionScheme::kCatmullClark;
  SubdivisionBoundary boundary = SubdivisionBoundary::kAll;
  int level = 2;      // 1 .. kMaxSubdivisionLevel
  bool limit = true;  // positions on the limit surface; false: those of the refined polygons
};

// A subdivided cage. Rows of `positions` sum to 1, those of the tangents to 0. Refined vertices are ordered by level:
// first the images of the cage's vertices, in their order (as in Blender's evaluated mesh, which numbers the others
// otherwise), then those added by the first level, of faces, then of edges, then those of the second, and so on: the
// vertices of level k are the first ones of level k + 1. A cage vertex in no face keeps its place. It and non-manifold
// vertices have zero tangents. A crease sharper than the level counts as infinitely sharp, and the limit at the end of
// a sharp crease is that of a smooth vertex, both as in OpenSubdiv: the error is 1e-4 of the size on a car with creases
// of sharpness 6 at level 3.
struct Subdivision {
  SparseMatrix positions;  // S, #refined x #V
  SparseMatrix tangent_u;  // #refined x #V; tangent_u x tangent_v points outside where the cage's faces are
  SparseMatrix tangent_v;  //   counter-clockwise, length without meaning; one side's tangents on a sharp crease
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> faces;  // #faces x 4, Loop: x 3
  IndexVector face_parent;                                                    // #faces: the cage's face
};

// Refines the cage's topology uniformly. Throws InvalidInput: what check_cage refuses, a level out of range, a result
// of more than 8 million faces, Loop with other faces than triangles, more faces at an edge or a vertex than OpenSubdiv
// has room for (at least 8 and 16), topology that OpenSubdiv refuses. Throws Cancelled between its steps.
Subdivision subdivide(const Cage& cage, const SubdivisionOptions& options, const Progress* progress = nullptr);

// Returns the unit limit normals (#refined x 3) of the cage with these positions (#V x 3); (0, 0, 1) where the tangents
// are parallel or vanish.
Positions limit_normals(const Subdivision& subdivision, const Positions& cage_positions);

}  // namespace reflines

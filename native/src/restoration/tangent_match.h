// The change of a region's heights that gives its followed border the tangents of the faces beside it.
#pragma once

#include <vector>

#include "reflines/border.h"
#include "reflines/image_plane.h"
#include "reflines/types.h"
#include "restoration/joined_mesh.h"

namespace reflines {

// The region is the first `vertices` and `triangles` of the mesh.
struct TangentMatch {
  const JoinedMesh& joined;
  Eigen::Index vertices, triangles;
  const std::vector<Border>& border;  // #vertices
  ImagePlane frame;
  Vector fraction = {};  // #vertices, or empty for 1: of the turn that is made; a side that moves makes the rest
};

// Returns what is to be added to the heights of the region's vertices, so that its slopes across the border become
// those beside it where both ends of an edge have Border::kFollow. `move` (#vertices) has been added to them already.
// The change is 0 on the border and beyond `width` of it, and nowhere more than `limit`, for which it reaches less far.
// Towards the ends of a followed stretch it fades over half of the width.
//
// It is made before a press looks for flaws: a kink along a border looks like the edge of a design, which it leaves
// alone. Of a kink of 3.4 degrees a press of the joined mesh alone leaves 3.3.
Vector match_tangents(const TangentMatch& match, const Vector& move, double width, double limit);

// Returns by how many degrees, at most, a change of the region's heights (#vertices) turns the triangles at its
// followed border.
double find_turn(const TangentMatch& match, const Vector& change);

}  // namespace reflines

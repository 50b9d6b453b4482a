// The images of a surface's vertices across its planes of symmetry, from wherever it is seen.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// Points of a surface as a view sees them.
struct SeenPoints {
  Positions P;           // #V x 3: place in the image plane, and height along the view
  PlanePositions slope;  // #V x 2: of the surface over the image plane
  Vector tolerance;      // #V: how far aside an image may lie
};

// A plane n . p = offset, n being of unit length.
struct MirrorAcross {
  Vector3 normal;
  double offset;

  Vector3 of_point(const Vector3& p) const { return p - 2.0 * (normal.dot(p) - offset) * normal; }
  Vector3 of_direction(const Vector3& d) const { return d - 2.0 * normal.dot(d) * normal; }
};

struct MirrorImages {
  MirrorAcross plane;
  IndexVector image;  // #V: the vertex that is nearest to the mirrored place of each, itself where none is near
  Mask paired;        // #V: where that vertex is the image, but for a flaw along the view
  Vector aside;       // #V: how far aside, in the mean around, images lie beyond what flaws explain
  Vector weight;      // #V, 0 to 1: how surely the surface is symmetric there
  Vector kept;        // #V: the smooth part of what halves differ by, which is design
  Mask design;        // #V: where they differ by design, more steeply than by flaws
};

// Finds the images across all planes of symmetry, the nearest to a symmetry first: an order that a turned or scaled
// panel keeps. Tried are planes across `axes` (#A x 3, in the coordinates of the points), and those that the moments
// of the points over the plane of the normal `mean` allow: the principal axes and those of a square and a triangle.
// A point is paired with an image that lies, but for its tolerance, no further from it than flaws are deep along the
// view, its mirror image or the normal. A surface is symmetric by place: where points within a length of flaws are
// paired. Nothing is design yet.
std::vector<MirrorImages> find_mirror_images(const SeenPoints& points, double diagonal, double length,
                                             const Positions& axes, const Vector3& mean);

// Returns the smooth part of what halves differ by (#V), over the plane of the normal `mean`.
Vector find_kept_difference(const SeenPoints& points, const MirrorImages& images, const Vector3& mean, double diagonal,
                            double length);

// Returns by how much the mirrored surface is higher along the view than each point (#V): the tangent plane of the
// point's image, which a flaw along a normal, or along a view that is not in the plane of symmetry, has moved aside.
// With the heights of partners instead, the skirt of a dent in a cylinder that slopes by 11 and 17 degrees was taken
// out, and the edge left around its core was kept as design: 0.99 and 0.51 stayed.
Vector find_mirrored_rise(const SeenPoints& points, const MirrorImages& images);

}  // namespace reflines

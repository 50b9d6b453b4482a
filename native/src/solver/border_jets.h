// Fits jets, the derivatives of polynomials, to the surroundings of a region at the vertices of its border.
#pragma once

#include <map>
#include <vector>

#include "geometry/derivatives.h"
#include "geometry/height_field.h"
#include "geometry/height_fit.h"
#include "reflines/border.h"
#include "reflines/image_plane.h"
#include "reflines/surroundings.h"

namespace reflines {

// The derivatives of the surroundings at a border vertex.
struct BorderJet {
  Vector5 u = Vector5::Zero();
  Vector4 third = Vector4::Zero();  // f_xxx, f_xxy, f_xyy, f_yyy
  double second_error = 0;          // see HeightFit
  double third_error = 0;           // likewise
  double range = 0;                 // the distance at which third derivatives change the second ones by their size
  bool flows = false;               // the third derivatives are wanted and known

  // Returns the derivatives at a place beside the vertex: of a jet that flows those of its polynomial there, beyond its
  // range those that it has in this direction at the range; of others the vertex's own.
  Vector5 at(const Vector2& place) const;
};

struct BorderJets {
  std::map<int, BorderJet> of_vertex;
  int unknown = 0;   // vertices whose surroundings tell no second derivatives
  int constant = 0;  // vertices with Border::kFlow whose surroundings tell no third derivatives
};

// Fits the surroundings of the border vertices with Border::kCurvature or kFlow. Slopes, second and third derivatives
// at such a vertex are those of a polynomial (see fit_heights) through three rings of their vertices around it and
// nothing of the region but its border; second and third ones are averaged along the border. Where a crease lies within
// these rings, the border itself among them, the surface does not run on, and they tell nothing. Nor do they where
// noise hides the second derivatives. Third derivatives count as known where their standard error is below half of
// themselves, or changes the second derivatives over `range` by less than a tenth.
BorderJets fit_border_jets(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                           const Surroundings& around, const ImagePlane& frame, const CreaseOptions& creases,
                           double range);

}  // namespace reflines

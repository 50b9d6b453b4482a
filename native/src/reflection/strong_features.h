// Finds extended strong bends, such as fillets, hems and gaps, whose lines smoothing keeps.
#pragma once

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines {

// Marks the features (#T) of a field (#T x 2): connected triangles whose |grad theta| is over 8 times the region's
// median and over 10 / diagonal, and that together extend farther than `length`. A strong bend shorter than the
// length in every direction is a flaw and is smoothed; an extended one is design, as a fillet of 4 cm radius is, which
// a smoothing length of 0.2 m would remove.
Mask strong_features(const HeightField& field, const PlaneVectors& gradient, double length);

// Measures how far the tools change the lines of each triangle (#T) of a field (#T x 2): 1 up to a third of `strong`,
// the size of a strong bend (see find_strong_size), falling to 0 at 4/3 of it. A redescending weight, as robust
// estimators have it, since rims and hems that are too short for a feature carry most of the squares.
Vector measure_response(const PlaneVectors& gradient, double strong);

// Returns 8 times the median |grad theta| by area of a field (#T x 2), or 10 / diagonal where that is more.
double find_strong_size(const PlaneVectors& gradient, const Vector& area, double diagonal);

// Returns the least |grad theta| of a feature in a field (#T x 2) over a piece with this diagonal.
double strong_bend(const PlaneVectors& gradient, double diagonal);

}  // namespace reflines

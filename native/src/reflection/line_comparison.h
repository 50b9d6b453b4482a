// Compares the lines of a field with their smooth course.
#pragma once

#include "reflines/line_score.h"
#include "reflines/types.h"

namespace reflines {

// The sums of a score over triangles, so that pieces add up.
struct LineSums {
  double shift = 0.0, area = 0.0;  // shift by area
  double turn = 0.0, drawn = 0.0;  // turn by length of the lines that are drawn

  LineSums& operator+=(const LineSums& other);
  LineScore score() const;
};

// Compares g (#F x 2) with its smooth course (#F x 2); `weight` (#F) are areas, 0 for what is not scored. No feature is
// left out: without those that bend far more than the panel a groove of 3 mm scored less than one of 2 mm. A shift
// counts at most 45 degrees instead, and the mean is that of the first power, so that fillets and hems, which have no
// smooth course, have the weight of their area and no more.
LineSums compare_lines(const PlaneVectors& g, const PlaneVectors& course, const Vector& weight, double length);

}  // namespace reflines

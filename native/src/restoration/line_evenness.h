// Measures how even the lines of a press's start and result are, in each light: how far they are from their course.
#pragma once

#include <vector>

#include "reflines/line_score.h"
#include "reflines/types.h"
#include "restoration/controlled_surface.h"

namespace reflines {

// Tells how far lines are from those of the smoothed surface.
struct Unevenness {
  std::vector<double> degrees;   // of theta, root mean square over the area seen, one for each light
  std::vector<LineScore> score;  // likewise
  std::vector<double> seen;      // fraction of the area that the light's eye sees, likewise
  Eigen::MatrixXd squares;       // #F x lights: of the offsets of theta, degrees^2, as the light's eye sees them
  Vector line_deviation;         // #F or of a cage #faces: see SmoothPanelReport::line_deviation
};

// Returns how far the lines of heights z (#V) are from those of the heights `course` (#V) in the light with index
// `family`: #F, radians of theta, root mean square over each triangle, wherever its eye sees it.
Vector measure_offsets(ControlledSurface& surface, const Vector& z, const Vector& course, int family);

// Compares the lines of heights z (#V) with those of their smoothed selves (#V); `length` is the size of flaws.
Unevenness measure_unevenness(ControlledSurface& surface, const Vector& z, const Vector& smoothed, double length);

}  // namespace reflines

// Targets that follow an image: the wanted change of theta is a grey image laid over the image plane (paper, Figure 12
// right).
#pragma once

#include "reflines/region_field.h"
#include "reflines/target.h"

namespace reflines {

struct PatternOptions {
  double strength = 1.0;  // radians of theta between black (0) and white (1)
  double blur = 0.0;      // standard deviation of a Gaussian, pixels; a sharp image asks for what no surface has
  double keep = 1.0;      // of the current lines: 1 adds the pattern to them, 0 replaces them by it
  Vector2 centre = Vector2::Zero();  // where the image's centre lies in the image plane
  double width = 1.0;                // of the image in the image plane, length; its height follows from its pixels
  double angle = 0.0;                // radians, counter-clockwise
  bool by_value = false;             // each line where the image puts it (eq. 3), black leaving it where it is
};

// `image` #rows x #columns, the first row at the bottom, grey values (0 black, 1 white). Outside the image its border
// values continue. Features (field.feature) keep their lines. By value, `keep` scales theta about its mean over the
// region. strength 0 with keep 1 changes no bit of the field. Throws InvalidInput for an empty image or one not finite.
Target build_pattern_target(const RegionField& field, const Eigen::MatrixXd& image, const PatternOptions& options);

}  // namespace reflines

// Targets that follow an image: the wanted change of theta is a grey image laid over the image plane (paper, Figure 12
// right).
#pragma once

#include "reflines/region_field.h"
#include "reflines/target.h"

namespace reflines {

struct PatternOptions {
  double strength = 1.0;  // radians of theta between black (0) and white (1)
  double blur = 0.0;      // standard deviation of a Gaussian, pixels; no surface shows the gradients of a sharp image
  double keep = 1.0;      // factor of the current lines: 1 adds the pattern to them, 0 replaces them by it
  Vector2 centre = Vector2::Zero();  // place of the image's centre in the image plane
  double width = 1.0;     // width of the image in the image plane, length; its height follows from its pixels
  double angle = 0.0;     // radians, counter-clockwise
  bool by_value = false;  // fits theta itself (eq. 3), where black leaves the lines in place; else only its gradient
};

// Builds the target of an image: `image` holds #rows x #columns grey values (0 black, 1 white), the first row at the
// bottom. Outside the image its border values continue. Features and rims keep their lines (field.response). With
// by_value, `keep` scales theta about its mean over the region. strength 0 with keep 1 changes no bit of the field.
// Throws InvalidInput for an image that is empty or not finite.
Target build_pattern_target(const RegionField& field, const Eigen::MatrixXd& image, const PatternOptions& options);

}  // namespace reflines

// The score of lines: how far they are from their smooth course, in two numbers that can be checked on a picture.
#pragma once

namespace reflines {

struct LineScore {
  // Mean over the area, degrees of theta: how far the lines shift sideways from their smooth course within one length.
  // With n lines round the circle it is n / 360 times as many distances of two lines. A shift counts as at most 45
  // degrees.
  double shift = 0.0;
  // Mean along the lines, degrees in the image plane: the angle between a line and its smooth course.
  double turn = 0.0;
};

}  // namespace reflines

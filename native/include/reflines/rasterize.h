// Draws triangles into a picture: which of them is seen in each pixel, and where in it.
#pragma once

#include "reflines/types.h"

namespace reflines {

inline constexpr int kMostPixels = 1 << 26;  // of a picture

// Pixels by rows, from the top left one.
struct Raster {
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> triangle;  // or -1
  // The weights of the triangle's second and third corner at the pixel's middle; 0 where there is none.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> second, third;
};

// Draws triangles F of points (#V x 3: pixels to the right and down, and nearness to the viewer). Of several in a pixel
// the nearest is seen; it does not matter which way round they are. Throws InvalidInput.
Raster rasterize(const Positions& points, const Triangles& F, int width, int height);

}  // namespace reflines

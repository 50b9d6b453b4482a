// Finds the places of a surface where a value stands out.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

struct Peak {
  int top;                     // the triangle with the largest value
  std::vector<int> triangles;  // ascending: those around it with half of its value or more
};

// Returns the peaks of `values` (#T, >= 0) above `floor`, the highest first, of equal ones that of the first triangle.
// `neighbors` (#T x 3) are the triangles across each edge, or -1. Two tops are one peak where the way from one to the
// other does not lead below 0.7 times the lower one (the persistence of superlevel sets).
std::vector<Peak> find_peaks(const Vector& values, const Triangles& neighbors, double floor);

}  // namespace reflines

// The weighted median.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the value below and above which `values` (#n) have half of the weight (#n, >= 0) each; 0 of no values.
double weighted_median(const Vector& values, const Vector& weight);

}  // namespace reflines

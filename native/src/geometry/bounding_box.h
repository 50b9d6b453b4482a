// The axis-aligned bounding box of positions.
#pragma once

#include "reflines/types.h"

namespace reflines {

double bounding_box_diagonal(const Positions& V);  // #V x 3, not empty

}  // namespace reflines

// Computes a fill-reducing elimination order by geometric nested dissection (George 1973), for unknowns in a plane.
#pragma once

#include <vector>

#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// Returns the order in which to eliminate the unknowns of a symmetric matrix (lower triangle, n x n), first to last.
// `places` (n x 2) are hints: any values give a valid order, those of a surface's vertices a good one.
// `progress` may be null; throws Cancelled.
std::vector<int> dissection_order(const SparseMatrix& matrix, const PlanePositions& places,
                                  const Progress* progress = nullptr);

}  // namespace reflines

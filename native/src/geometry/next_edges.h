// The edges of a border in the order in which they follow each other, up to corners.
#pragma once

#include <functional>
#include <vector>

#include "reflines/types.h"

namespace reflines {

// Finds the edge that goes on where each of the edges (#E x 2: first and second vertex, of V, #V x 3) ends, or -1:
// there is none at a corner, where they turn by more than 40 degrees, nor where `belong` returns false for the two.
std::vector<int> find_next_edges(const Positions& V, const Edges& edges,
                                 const std::function<bool(int edge, int next)>& belong);

}  // namespace reflines

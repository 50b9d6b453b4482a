// Chooses at each place up to which length the fields of the lines are smoothed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reflines/types.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {

// Returns the share (#F x (#changes - 1), rows sum to 1) of each length but the longest, by the quasi-optimality
// criterion (Tikhonov and Glasko 1965) at each place: `changes` (#F x m each) are those that smoothing makes to a field
// by lengths of which each is twice the one before, and the best length is that of which the next one's change differs
// least. A flaw wider than a length is taken out further by the next; once it is gone the next takes the same, until it
// takes of the design. Where a change is design, by its `weight` as a flaw (see flaw_weight; of the shape of the
// result), its length has the less. A single length has all. `centers` (#F x 2) and `area` (#F) are those of the
// triangles, `length` is the shortest one.
Eigen::MatrixXd share_lengths(const std::vector<TriangleFields>& changes, const Eigen::MatrixXd& weight,
                              const PlanePositions& centers, const Vector& area, double length);

}  // namespace reflines

// Finds where a surface got worse in lights that took no part in its solve, each seen by an eye of its own.
#pragma once

#include "reflines/smooth_panel.h"
#include "reflines/types.h"
#include "restoration/disk_mean.h"
#include "solver/families.h"

namespace reflines {

// The slopes of a surface before and after a solve, and those that each would have without flaws: #F x 2 each.
struct ChangedSlopes {
  PlaneVectors before, course_before, after, course_after;
};

// Replaces `worst` by the place (by V, #V x 3, and F, #F x 3) where lines got worse by more: by at least `least`
// degrees, and off their course by kWorst or more. `before` and `after` (#F x lights) are degrees in lights whose
// numbers begin at `first`.
void take_worse(const Eigen::Ref<const Eigen::MatrixXd>& before, const Eigen::Ref<const Eigen::MatrixXd>& after,
                int first, const Positions& V, const Triangles& F, double least, WorsePlace& worst);

// Returns the place (by V, #V x 3, and F, #F x 3) where lines got worse by most in one of the lights: by at least
// `least` degrees, means `around` each place, and off their course by kWorst or more.
WorsePlace find_worse_place(const Families& lights, const ChangedSlopes& slopes, const DiskMean& around,
                            const Positions& V, const Triangles& F, double least);

}  // namespace reflines

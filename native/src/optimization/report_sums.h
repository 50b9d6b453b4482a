// Sums of the reports on several minimizations that make up one solve.
#pragma once

#include "reflines/report.h"

namespace reflines {

// Adds the report on one piece to that on the pieces before it: counts of work and energies are summed, iterations are
// those of the slowest piece, and the least favourable termination is kept.
void add_piece_report(const Report& piece, Report& sum);

// Adds the report on a later round for the same piece: all counts of work are summed, energies and gradients are those
// of the first round. A cancelled round cancels the whole.
void add_round_report(const Report& round, Report& sum);

}  // namespace reflines

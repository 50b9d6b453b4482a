// The lines of the table for one shut line.
#pragma once

#include <vector>

#include "reflines/shut_lines.h"

namespace reflines {

// Returns the rows of the edges of a line, see ShutLine, with the places (#E x 3) where they are measured.
std::vector<CheckRow> list_rows(const std::vector<int>& edges, const ShutMeasures& before, const ShutMeasures& after,
                                const Positions& places, const ShutLineOptions& options);

}  // namespace reflines

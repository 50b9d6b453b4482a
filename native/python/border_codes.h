// Reads borders from Python: one name for all vertices, or a code for each.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "python/index_arrays.h"
#include "reflines/shape_optimizer.h"

namespace reflines {

using Codes = std::variant<std::string, Indices>;

// Returns #V borders from "free", "fixed", "clamped" or "curvature", or from #V codes 0 to 3. Throws InvalidInput for
// others.
std::vector<Border> border_codes(const Codes& border, Eigen::Index vertex_count);

}  // namespace reflines

// Reads borders from Python: one name for all vertices, or a code for each.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "python/index_arrays.h"
#include "reflines/shape_optimizer.h"

namespace reflines {

using Codes = std::variant<std::string, Indices>;

// Returns #V borders from a name of option_names.h, or from #V codes of Border. Throws InvalidInput for others.
std::vector<Border> border_codes(const Codes& border, Eigen::Index vertex_count);

}  // namespace reflines

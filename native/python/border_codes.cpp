#include "python/border_codes.h"

#include "python/option_names.h"
#include "reflines/errors.h"

namespace reflines {

std::vector<Border> border_codes(const Codes& border, Eigen::Index vertex_count) {
  if (std::holds_alternative<std::string>(border)) {
    return std::vector<Border>(vertex_count, find_named(kBorders, std::get<std::string>(border), "border"));
  }
  const IndexVector codes = index_vector(std::get<Indices>(border));
  if (codes.size() > 0 && (codes.minCoeff() < 0 || codes.maxCoeff() > 5)) {
    throw InvalidInput(
        "Border codes are 0 (free), 1 (fixed), 2 (clamped), 3 (curvature), 4 (flow) and 5 (follow); one is " +
        std::to_string(codes.minCoeff() < 0 ? codes.minCoeff() : codes.maxCoeff()) + ".");
  }
  std::vector<Border> result;
  for (int code : codes) result.push_back(static_cast<Border>(code));
  return result;
}

}  // namespace reflines

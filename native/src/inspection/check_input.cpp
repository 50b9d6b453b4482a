#include "inspection/check_input.h"

#include <cmath>
#include <string>

#include "geometry/mesh.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

void check_sizes(const Positions& before, const Positions& after, const Triangles& F, const Mask& region) {
  if (after.rows() != before.rows()) {
    throw InvalidInput("There are " + std::to_string(before.rows()) + " vertices before and " +
                       std::to_string(after.rows()) + " after; give the same mesh.");
  }
  if (region.size() != F.rows()) {
    throw InvalidInput("The region's mask has " + std::to_string(region.size()) + " entries for " +
                       std::to_string(F.rows()) + " triangles; give one for each.");
  }
}

}  // namespace

void check_compared(const Positions& before, const Positions& after, const Triangles& F, const Mask& region) {
  check_sizes(before, after, F, region);
  check_indices(before, F);
  const Triangles own = F(list_marked(region), Eigen::all);
  check_surface(before, own);
  check_surface(after, own);
  int nowhere = 0;
  for (int t = 0; t < F.rows(); ++t) {
    const bool placed = before(F.row(t), Eigen::all).allFinite() && after(F.row(t), Eigen::all).allFinite();
    nowhere += !placed;
  }
  if (nowhere > 0) {
    throw InvalidInput(std::to_string(nowhere) +
                       " triangles beside the region have a coordinate that is not a finite number.");
  }
}

void check_mark(double mark, const char* name) {
  if (mark >= 0 && std::isfinite(mark)) return;
  throw InvalidInput(std::string("The pass mark for the ") + name + " must be 0 or a positive finite number.");
}

}  // namespace reflines

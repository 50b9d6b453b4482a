#include "reflection/weighted_median.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace reflines {
namespace {

struct Entry {
  double value, weight;
};

}  // namespace

// Selects by halves, as std::nth_element does: sorting took a quarter of the smoothing of 300,000 edges.
double weighted_median(const Vector& values, const Vector& weight) {
  if (values.size() == 0) return 0.0;
  std::vector<Entry> entries(values.size());
  for (Eigen::Index k = 0; k < values.size(); ++k) entries[k] = {values(k), weight(k)};
  auto first = entries.begin(), last = entries.end();
  double missing = 0.5 * weight.sum();  // of the weight below the median, from `first` on
  while (last - first > 1) {
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [](const Entry& one, const Entry& other) { return one.value < other.value; });
    const double below =
        std::accumulate(first, middle, 0.0, [](double sum, const Entry& entry) { return sum + entry.weight; });
    if (below >= missing) {
      last = middle;
    } else {
      missing -= below;
      first = middle;
    }
  }
  return first->value;
}

}  // namespace reflines

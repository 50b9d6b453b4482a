#include "reflection/weighted_median.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace reflines {

double weighted_median(const Vector& values, const Vector& weight) {
  if (values.size() == 0) return 0.0;
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return std::pair(values(i), i) < std::pair(values(j), j); });
  const double half = 0.5 * weight.sum();
  double below = 0;
  for (const int k : order) {
    below += weight(k);
    if (below >= half) return values(k);
  }
  return values(order.back());
}

}  // namespace reflines

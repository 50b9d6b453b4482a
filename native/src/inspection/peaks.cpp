#include "inspection/peaks.h"

#include <algorithm>
#include <numeric>

namespace reflines {
namespace {

// The fraction of the lower of two tops below which the saddle between them has to lie for them to be two peaks.
constexpr double kApart = 0.7;

constexpr double kExtent = 0.5;  // of the top's value: what belongs to the peak

// Returns the triangles above the floor in the order of their values, the largest first.
std::vector<int> sort_by_value(const Vector& values, double floor) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::erase_if(order, [&](int t) { return !(values(t) > floor); });
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return values(a) > values(b); });
  return order;
}

// The hills that triangles make which are added from the highest down: each is known by its top.
class Hills {
 public:
  explicit Hills(const Vector& values) : values_(values), top_(values.size(), -1), over_(values.size()) {
    std::iota(over_.begin(), over_.end(), 0);
  }

  // Adds a triangle to the highest hill beside it, or as the top of a new one. A lower hill that it joins to that one
  // is no peak of its own where it hardly stands out from the way there.
  void add(int t, const Triangles& neighbors) {
    int highest = -1;
    for (int i = 0; i < 3; ++i) {
      const int other = neighbors(t, i);
      if (other >= 0 && top_[other] >= 0) highest = join(highest, top_of(other), values_(t));
    }
    top_[t] = highest < 0 ? t : highest;
  }

  // Returns the top of the peak that a triangle belongs to, -1 where it was not added.
  int top_of(int t) {
    if (top_[t] < 0) return -1;
    int top = top_[t];
    while (over_[top] != top) top = over_[top] = over_[over_[top]];
    return top_[t] = top;
  }

 private:
  int join(int one, int other, double saddle) {
    if (one < 0 || one == other) return other;
    const bool ordered = values_(one) >= values_(other);
    const int high = ordered ? one : other, low = ordered ? other : one;
    if (saddle >= kApart * values_(low)) over_[low] = high;
    return high;
  }

  const Vector& values_;
  std::vector<int> top_;   // of each triangle, as it was when that was added or asked for
  std::vector<int> over_;  // of each top the one whose peak it belongs to, or itself
};

}  // namespace

std::vector<Peak> find_peaks(const Vector& values, const Triangles& neighbors, double floor) {
  const std::vector<int> order = sort_by_value(values, floor);
  Hills hills(values);
  for (const int t : order) hills.add(t, neighbors);
  std::vector<Peak> result;
  std::vector<int> number(values.size(), -1);  // of the peak, of each top
  for (const int t : order) {
    if (hills.top_of(t) != t) continue;
    number[t] = static_cast<int>(result.size());
    result.push_back({t, {}});
  }
  for (int t = 0; t < values.size(); ++t) {
    const int top = hills.top_of(t);
    if (top >= 0 && values(t) >= kExtent * values(top)) result[number[top]].triangles.push_back(t);
  }
  return result;
}

}  // namespace reflines

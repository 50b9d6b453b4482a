#include "inspection/compare_values.h"

#include <algorithm>

namespace reflines {

Change compare_values(double before, double after, double mark) {
  const auto grew = [mark](double from, double to) { return to - from > mark || (from <= mark && to > mark); };
  if (grew(before, after)) return Change::kWorse;
  return grew(after, before) ? Change::kBetter : Change::kUnchanged;
}

Change sum_up(std::initializer_list<Change> changes) {
  for (const Change change : {Change::kWorse, Change::kBetter}) {
    if (std::find(changes.begin(), changes.end(), change) != changes.end()) return change;
  }
  return Change::kUnchanged;
}

}  // namespace reflines

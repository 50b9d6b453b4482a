// Sorted lists without repetitions.
#pragma once

#include <algorithm>
#include <vector>

namespace reflines {

inline void sort_unique(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace reflines

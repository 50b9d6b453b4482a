// Disjoint sets of the numbers 0 .. n - 1 (union-find with path halving), each represented by its smallest member.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <vector>

namespace reflines {

class UnionFind {
 public:
  // Puts each of 0 .. size - 1 into a set of its own.
  explicit UnionFind(Eigen::Index size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

  // Returns the smallest member of the set that contains `member`.
  int find(int member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }

  void unite(int first, int second) {
    const int a = find(first), b = find(second);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  // Returns the sets in the order of their smallest members, each with its members ascending.
  std::vector<std::vector<int>> list_sets() {
    std::vector<std::vector<int>> result;
    std::vector<int> number(parent_.size());
    for (int member = 0; member < static_cast<int>(parent_.size()); ++member) {
      const int first = find(member);
      if (first == member) {
        number[first] = static_cast<int>(result.size());
        result.emplace_back();
      }
      result[number[first]].push_back(member);
    }
    return result;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace reflines

#include "native/optimization/dissection.h"

#include <algorithm>
#include <numeric>

namespace reflines {

namespace {

// Parts of this size are eliminated as they come: between 16 and 64 the entries of L differ by 3 %.
constexpr int kSmallestPart = 32;

struct Part {
  int begin, end;  // in the order
};

class Dissection {
 public:
  Dissection(const SparseMatrix& matrix, const PlanePositions& places)
      : matrix_(matrix), places_(places), order_(matrix.rows()), side_(matrix.rows(), kOutside) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  std::vector<int> run() {
    std::vector<Part> parts = {{0, static_cast<int>(order_.size())}};
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      if (part.end - part.begin > kSmallestPart) cut(part, parts);
    }
    return std::move(order_);
  }

 private:
  enum Side : signed char { kOutside, kLeft, kRight, kSeparator };

  // Across the longer side of the part's bounding box, half of the unknowns on each side.
  int halve(const Part& part) {
    Vector2 low = places_.row(order_[part.begin]), high = low;
    for (int k = part.begin; k < part.end; ++k) {
      low = low.cwiseMin(places_.row(order_[k]).transpose());
      high = high.cwiseMax(places_.row(order_[k]).transpose());
    }
    const int axis = (high - low).x() >= (high - low).y() ? 0 : 1;
    const auto before = [this, axis](int a, int b) {
      return places_(a, axis) != places_(b, axis) ? places_(a, axis) < places_(b, axis) : a < b;
    };
    const int middle = (part.begin + part.end) / 2;
    std::nth_element(order_.begin() + part.begin, order_.begin() + middle, order_.begin() + part.end, before);
    return middle;
  }

  // The unknowns of one side that touch the other one, of the side that has fewer of them.
  void mark_separator(const Part& part) {
    touching_[0].clear();
    touching_[1].clear();
    for (int k = part.begin; k < part.end; ++k) {
      const int column = order_[k];
      for (int e = matrix_.outerIndexPtr()[column]; e < matrix_.outerIndexPtr()[column + 1]; ++e) {
        const int row = matrix_.innerIndexPtr()[e];
        if (side_[row] == kOutside || side_[row] == side_[column]) continue;
        touching_[side_[row] == kRight].push_back(row);
        touching_[side_[column] == kRight].push_back(column);
      }
    }
    for (std::vector<int>& some : touching_) {
      std::sort(some.begin(), some.end());
      some.erase(std::unique(some.begin(), some.end()), some.end());
    }
    for (const int v : touching_[touching_[1].size() < touching_[0].size()]) side_[v] = kSeparator;
  }

  // Left and right first, the separator last: only it is filled in between them.
  void cut(const Part& part, std::vector<Part>& parts) {
    const int middle = halve(part);
    for (int k = part.begin; k < part.end; ++k) side_[order_[k]] = k < middle ? kLeft : kRight;
    mark_separator(part);
    const auto end = order_.begin() + part.end;
    const auto on = [this](Side side) { return [this, side](int v) { return side_[v] == side; }; };
    const auto right = std::stable_partition(order_.begin() + part.begin, end, on(kLeft));
    const auto separator = std::stable_partition(right, end, on(kRight));
    for (int k = part.begin; k < part.end; ++k) side_[order_[k]] = kOutside;
    const int right_begin = static_cast<int>(right - order_.begin());
    parts.push_back({part.begin, right_begin});
    parts.push_back({right_begin, static_cast<int>(separator - order_.begin())});
  }

  const SparseMatrix& matrix_;
  const PlanePositions& places_;
  std::vector<int> order_;
  std::vector<Side> side_;
  std::vector<int> touching_[2];  // work space: unknowns of the left and of the right side that touch the other one
};

}  // namespace

std::vector<int> dissection_order(const SparseMatrix& matrix, const PlanePositions& places) {
  return Dissection(matrix, places).run();
}

}  // namespace reflines

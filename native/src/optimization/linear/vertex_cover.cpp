#include "optimization/linear/vertex_cover.h"

#include <cstddef>
#include <utility>

namespace reflines {

namespace {

constexpr int kNobody = -1;

class Matching {
 public:
  Matching(const std::vector<BipartiteEdge>& edges, int left_count, int right_count)
      : edges_(edges),
        first_edge_(left_count + 1),
        partner_(left_count, kNobody),
        mate_(right_count, kNobody),
        in_tree_{std::vector<char>(left_count), std::vector<char>(right_count)},
        from_(right_count) {
    for (const BipartiteEdge& edge : edges) ++first_edge_[edge.first + 1];
    for (int l = 0; l < left_count; ++l) first_edge_[l + 1] += first_edge_[l];
  }

  VertexCover cover(std::size_t patience) {
    take_free_partners();
    for (std::size_t l = 0; l < partner_.size() && looked_at_ < patience * edges_.size(); ++l) {
      if (partner_[l] == kNobody) grow_tree(static_cast<int>(l));
    }
    for (char& reached : in_tree_.left) reached = !reached;
    return std::move(in_tree_);
  }

 private:
  void take_free_partners() {
    for (const auto& [l, r] : edges_) {
      if (partner_[l] == kNobody && mate_[r] == kNobody) match(l, r);
    }
  }

  void match(int l, int r) {
    mate_[r] = l;
    partner_[l] = r;
  }

  // Grows an alternating tree from a left vertex: alternately any edge and one of the matching, until a free right
  // vertex is found. A tree that finds none is kept: later trees never gain by entering it, and in the end the right
  // vertices in such trees and the left ones in none are a cover.
  void grow_tree(int root) {
    lefts_.assign(1, root);
    rights_.clear();
    for (std::size_t next = 0; next < lefts_.size(); ++next) {
      const int l = lefts_[next];
      for (int e = first_edge_[l]; e < first_edge_[l + 1]; ++e, ++looked_at_) {
        const int r = edges_[e].second;
        if (in_tree_.right[r]) continue;
        in_tree_.right[r] = true;
        from_[r] = l;
        rights_.push_back(r);
        if (mate_[r] == kNobody) return exchange_partners(root, r);
        lefts_.push_back(mate_[r]);
      }
    }
    for (const int l : lefts_) in_tree_.left[l] = true;
  }

  void exchange_partners(int root, int free_right) {
    for (const int r : rights_) in_tree_.right[r] = false;
    for (int r = free_right, l = kNobody; l != root;) {
      l = from_[r];
      const int left_behind = partner_[l];
      match(l, r);
      r = left_behind;
    }
  }

  const std::vector<BipartiteEdge>& edges_;
  std::vector<int> first_edge_;  // #left + 1: first edge of each left vertex, and the number of edges
  std::vector<int> partner_;     // #left: matched right vertex
  std::vector<int> mate_;        // #right: matched left vertex
  VertexCover in_tree_;
  std::vector<int> from_;            // #right: predecessor of each right vertex of the growing tree
  std::vector<int> lefts_, rights_;  // vertices of the growing tree
  std::size_t looked_at_ = 0;
};

}  // namespace

VertexCover minimum_vertex_cover(const std::vector<BipartiteEdge>& edges, int left_count, int right_count,
                                 std::size_t patience) {
  return Matching(edges, left_count, right_count).cover(patience);
}

}  // namespace reflines

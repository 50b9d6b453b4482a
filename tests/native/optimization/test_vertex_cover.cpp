// The cover touches every edge, and no smaller set does: compared with all sets of vertices of small graphs.
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "optimization/linear/vertex_cover.h"

namespace reflines {
namespace {

constexpr int kSide = 6;

int size_of(const VertexCover& cover) {
  int size = 0;
  for (const char in : cover.left) size += in;
  for (const char in : cover.right) size += in;
  return size;
}

bool covers(const VertexCover& cover, const std::vector<BipartiteEdge>& edges) {
  for (const auto& [l, r] : edges) {
    if (!cover.left[l] && !cover.right[r]) return false;
  }
  return true;
}

// Of all sets, as bits: left vertices first.
int smallest_cover(const std::vector<BipartiteEdge>& edges) {
  int smallest = std::numeric_limits<int>::max();
  for (unsigned set = 0; set < 1u << (2 * kSide); ++set) {
    bool all = true;
    for (const auto& [l, r] : edges) all = all && ((set >> l & 1) || (set >> (kSide + r) & 1));
    if (all) smallest = std::min(smallest, std::popcount(set));
  }
  return smallest;
}

TEST(VertexCoverTest, IsASmallestOneOfRandomGraphs) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<BipartiteEdge> edges;
    for (int l = 0; l < kSide; ++l) {
      edges.emplace_back(l, static_cast<int>(random() % kSide));
      for (int r = edges.back().second + 1; r < kSide; ++r) {
        if (random() % 4 == 0) edges.emplace_back(l, r);
      }
    }
    const VertexCover cover = minimum_vertex_cover(edges, kSide, kSide);
    EXPECT_TRUE(covers(cover, edges));
    EXPECT_EQ(size_of(cover), smallest_cover(edges)) << "graph " << trial;
  }
}

TEST(VertexCoverTest, TakesTheHubsOfStars) {
  const VertexCover cover = minimum_vertex_cover({{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}}, 3, 3);
  EXPECT_EQ(cover.left, (std::vector<char>{1, 0, 0}));
  EXPECT_EQ(cover.right, (std::vector<char>{0, 0, 1}));
}

// The first partners that are free leave a chain along which all have to exchange: 200,000 steps are no recursion.
TEST(VertexCoverTest, LongChainsDoNotOverflowTheStack) {
  constexpr int kLength = 200000;
  std::vector<BipartiteEdge> edges;
  for (int l = 0; l < kLength; ++l) {
    edges.emplace_back(l, l);
    if (l + 1 < kLength) edges.emplace_back(l, l + 1);
  }
  edges.emplace_back(kLength, 0);
  const VertexCover cover = minimum_vertex_cover(edges, kLength + 1, kLength);
  EXPECT_TRUE(covers(cover, edges));
  EXPECT_EQ(size_of(cover), kLength);
}

// The first left vertex takes the only partner of the second: without a search, both would count.
TEST(VertexCoverTest, CoversAlsoWhereTheMatchingIsNotCompleted) {
  const std::vector<BipartiteEdge> edges = {{0, 0}, {0, 1}, {1, 0}, {2, 1}, {2, 2}};
  const VertexCover hasty = minimum_vertex_cover(edges, 3, 3, 0);
  EXPECT_TRUE(covers(hasty, edges));
  EXPECT_EQ(size_of(minimum_vertex_cover(edges, 3, 3)), smallest_cover(edges));
  std::mt19937 random(5);
  std::vector<BipartiteEdge> many;
  for (int l = 0; l < 1000; ++l) {
    for (int r = static_cast<int>(random() % 400); r < 1000; r += 1 + static_cast<int>(random() % 600))
      many.emplace_back(l, r);
  }
  const int fewest = size_of(minimum_vertex_cover(many, 1000, 1000));
  for (const std::size_t patience : {0, 1}) {
    const VertexCover cover = minimum_vertex_cover(many, 1000, 1000, patience);
    EXPECT_TRUE(covers(cover, many));
    EXPECT_GE(size_of(cover), fewest);
  }
}

}  // namespace
}  // namespace reflines

#include <gtest/gtest.h>

#include "inspection/peaks.h"

namespace reflines {
namespace {

// A strip of triangles, each beside the next.
Triangles strip(int count) {
  Triangles neighbors = Triangles::Constant(count, 3, -1);
  for (int t = 0; t + 1 < count; ++t) {
    neighbors(t, 0) = t + 1;
    neighbors(t + 1, 1) = t;
  }
  return neighbors;
}

TEST(Peaks, TwoTopsAreOneUnlessTheWayBetweenThemIsLow) {
  Vector values(7);
  values << 0.1, 2.0, 1.5, 1.0, 1.6, 0.9, 0.1;
  const std::vector<Peak> two = find_peaks(values, strip(7), 0.5);
  ASSERT_EQ(two.size(), 2);
  EXPECT_EQ(two[0].top, 1);
  EXPECT_EQ(two[0].triangles, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(two[1].top, 4);
  EXPECT_EQ(two[1].triangles, (std::vector<int>{4, 5}));
  values(3) = 1.2;  // 0.75 of the lower top
  const std::vector<Peak> one = find_peaks(values, strip(7), 0.5);
  ASSERT_EQ(one.size(), 1);
  EXPECT_EQ(one[0].triangles, (std::vector<int>{1, 2, 3, 4}));
}

TEST(Peaks, NothingIsAPeakAtTheFloorOrBelow) {
  EXPECT_TRUE(find_peaks(Vector::Constant(5, 0.3), strip(5), 0.3).empty());
  EXPECT_EQ(find_peaks(Vector::Constant(5, 0.3), strip(5), 0.29).size(), 1);
}

}  // namespace
}  // namespace reflines

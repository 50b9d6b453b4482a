#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "reflection/weighted_median.h"

namespace reflines {
namespace {

TEST(WeightedMedian, OfFiveNumbersHasHalfTheWeightOnEitherSide) {
  Vector values(5), weight(5);
  values << 50, 10, 40, 20, 30;
  weight << 1, 1, 4, 2, 1;  // sorted 1, 2, 1, 4, 1: a quarter lies up to 20, half up to 40, and 30 is in the middle
  EXPECT_EQ(weighted_median(values, weight), 40);
  EXPECT_EQ(weighted_median(-values, weight), -40);
  EXPECT_EQ(weighted_median(values, Vector::Ones(5)), 30);
}

// The median minimizes the weighted sum of distances, which is piecewise linear with corners at the values.
TEST(WeightedMedian, HasTheLeastSumOfDistances) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> value(-9, 9), share(0, 4);
  for (int count = 1; count <= 40; ++count) {
    const Vector values = Vector::NullaryExpr(count, [&] { return value(random); });
    Vector weight = Vector::NullaryExpr(count, [&] { return share(random); });
    weight(0) += 1;
    const auto sum_distances = [&](double m) { return weight.dot((values.array() - m).abs().matrix()); };
    double least = sum_distances(values(0));
    for (const double m : values) least = std::min(least, sum_distances(m));
    EXPECT_EQ(sum_distances(weighted_median(values, weight)), least) << count << " values";
  }
}

// Values of many sizes and both signs, more than are sorted at once.
TEST(WeightedMedian, IsWhereTheSumOfSortedWeightsReachesHalf) {
  std::mt19937 random(7);
  std::normal_distribution<double> exponent(0.0, 8.0);
  for (const int count : {17, 400, 5000}) {
    std::vector<std::pair<double, double>> entries(count);
    for (auto& [value, weight] : entries)
      value = std::copysign(std::exp(exponent(random)), exponent(random)), weight = 1 + random() % 4;
    Vector values(count), weight(count);
    for (int k = 0; k < count; ++k) values(k) = entries[k].first, weight(k) = entries[k].second;
    std::sort(entries.begin(), entries.end());
    double below = 0;
    std::size_t k = 0;
    while (below + entries[k].second < 0.5 * weight.sum()) below += entries[k++].second;
    EXPECT_EQ(weighted_median(values, weight), entries[k].first) << count;
  }
}

}  // namespace
}  // namespace reflines

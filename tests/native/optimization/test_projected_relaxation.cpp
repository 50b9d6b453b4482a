// Projected over-relaxation ends at the contacts of the minimum, and stays within the bounds on the way.
#include <gtest/gtest.h>

#include "least_squares.h"
#include "optimization/minimizer.h"
#include "optimization/projected_relaxation.h"

namespace reflines {
namespace {

constexpr int kSize = 30;

struct Obstacle {
  explicit Obstacle(double limit) : bounds{Vector::Constant(kSize, -limit), Vector::Constant(kSize, limit)} {
    chain.set_minimum(chain.wave(1.0));
    H = chain.hessian(Vector::Zero(kSize), HessianModel::kGaussNewton);
    gradient.resize(kSize);
    chain.evaluate(Vector::Zero(kSize), &gradient);
  }

  SparseMatrix whole() const { return H.selfadjointView<Eigen::Lower>(); }

  Chain chain{kSize, 0.0};  // its energy is quadratic
  Bounds bounds;
  SparseMatrix H;
  Vector gradient;
};

TEST(ProjectedRelaxationTest, EndsAtTheContactsOfTheMinimum) {
  for (const double limit : {0.9, 0.5, 0.1}) {
    Obstacle obstacle(limit);
    const QuadraticModel model{obstacle.H, obstacle.gradient};
    Vector x = Vector::Zero(kSize);
    ASSERT_TRUE(Minimizer().minimize(obstacle.chain, obstacle.bounds, x).converged());
    const Sides held =
        relax_contacts(model, obstacle.whole(), obstacle.bounds, obstacle.chain.wave(1.0), 20000, nullptr);
    EXPECT_GT(count_held(held), 0);
    EXPECT_EQ(held, obstacle.bounds.touched_by(x)) << limit;
  }
}

TEST(ProjectedRelaxationTest, HoldsPointsAndKeepsWhatIsPressed) {
  Obstacle obstacle(0.5);
  obstacle.bounds.low(3) = obstacle.bounds.high(3) = 0.0;
  const QuadraticModel model{obstacle.H, obstacle.gradient};
  const Sides held = relax_contacts(model, obstacle.whole(), obstacle.bounds, obstacle.chain.wave(1.0), 1, nullptr);
  EXPECT_EQ(held[3], Side::kLow);
}

}  // namespace
}  // namespace reflines

// The projection onto smooth motions is P^T g and P^T H P exactly, and a far minimum is found through it with fewer
// factors.
#include <gtest/gtest.h>

#include <cmath>

#include "least_squares.h"
#include "native/optimization/minimizer.h"
#include "native/optimization/subspace.h"

namespace reflines {
namespace {

// A bent chain that offers parabolas over `reach` links as its smooth motions, one for every `stride` links.
class SmoothChain final : public Problem {
 public:
  SmoothChain(int size, double bend, int stride, int reach) : chain_(size, bend), modes_(size / stride, size) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int mode = 0; mode < size / stride; ++mode) {
      for (int k = 0; k < size; ++k) {
        const double t = (k - (mode + 0.5) * stride) / reach;
        if (std::abs(t) < 1.0) entries.emplace_back(mode, k, (1.0 - t * t) * (1.0 - t * t));
      }
    }
    modes_.setFromTriplets(entries.begin(), entries.end());
  }
  Chain& chain() { return chain_; }
  void withhold_motions() { offers_ = false; }

  int size() const override { return chain_.size(); }
  double evaluate(const Vector& x, Vector* gradient) override { return chain_.evaluate(x, gradient); }
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override { return chain_.hessian(x, model); }
  const SparseMatrix* smooth_modes() override { return offers_ ? &modes_ : nullptr; }

 private:
  Chain chain_;
  SparseMatrix modes_;
  bool offers_ = true;
};

struct SubspaceTest : testing::Test {
  SubspaceTest() : problem(120, 2.0, 8, 12), start(Vector::Zero(120)) {
    problem.chain().set_minimum(problem.chain().wave(1.0));
  }
  Report minimize(Vector& x, Progress* progress = nullptr) { return Minimizer().minimize(problem, x, {}, progress); }

  SmoothChain problem;
  Vector start;
};

TEST_F(SubspaceTest, IsTheGalerkinProjection) {
  const Vector origin = problem.chain().wave(0.5);
  Vector gradient(120);
  const double energy = problem.evaluate(origin, &gradient);
  const SparseMatrix& modes = *problem.smooth_modes();
  Subspace subspace(problem, modes, {origin, gradient, energy});
  const Vector c = Vector::LinSpaced(subspace.size(), -0.1, 0.2);
  const Vector x = origin + modes.transpose() * c;
  Vector reduced(subspace.size());
  EXPECT_NEAR(subspace.evaluate(c, &reduced), problem.evaluate(x, &gradient), 1e-12 * energy);
  EXPECT_LT((reduced - modes * gradient).norm(), 1e-12 * reduced.norm());

  const Eigen::MatrixXd dense = modes.toDense();
  for (int repeat = 0; repeat < 2; ++repeat) {
    const Eigen::MatrixXd lower = subspace.hessian(c, HessianModel::kGaussNewton).toDense();
    const Eigen::MatrixXd whole = problem.hessian(x, HessianModel::kGaussNewton).toDense();
    const Eigen::MatrixXd expected = dense * whole.selfadjointView<Eigen::Lower>() * dense.transpose();
    EXPECT_LT((lower - Eigen::MatrixXd(expected.triangularView<Eigen::Lower>())).norm(), 1e-12 * expected.norm());
  }
}

TEST_F(SubspaceTest, AsksForNoPointTwice) {
  Vector gradient(120);
  const double energy = problem.evaluate(start, &gradient);
  Subspace subspace(problem, *problem.smooth_modes(), {start, gradient, energy});
  Vector reduced(subspace.size());
  const Vector zero = Vector::Zero(subspace.size());
  EXPECT_EQ(subspace.evaluate(zero, &reduced), energy);
  EXPECT_EQ(subspace.evaluations(), 0);
  subspace.evaluate(Vector::Ones(subspace.size()), &reduced);
  subspace.evaluate(Vector::Ones(subspace.size()), nullptr);
  EXPECT_EQ(subspace.evaluations(), 1);
}

TEST_F(SubspaceTest, AFarMinimumTakesFewerFactors) {
  Vector x = start;
  const Report approached = minimize(x);
  Vector y = start;
  problem.withhold_motions();
  const Report direct = minimize(y);
  ASSERT_TRUE(approached.converged()) << approached.message;
  ASSERT_TRUE(direct.converged()) << direct.message;
  EXPECT_GT(approached.coarse_iterations, 0);
  EXPECT_EQ(direct.coarse_iterations, 0);
  EXPECT_LT(approached.factorizations, direct.factorizations);
  EXPECT_LE(approached.gradient_after, 1e-6 * direct.gradient_before);
  EXPECT_EQ(approached.gradient_before, direct.gradient_before);
}

// A zigzag does not yield to smooth motions: they are given up after one step, and nothing of it remains.
TEST_F(SubspaceTest, IsGivenUpWhereItDoesNotHelp) {
  Vector zigzag = problem.chain().wave(1.0);
  for (int k = 0; k < 120; ++k) zigzag[k] += k % 2 == 0 ? 1e-3 : -1e-3;
  const Report report = minimize(zigzag);
  EXPECT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.coarse_iterations, 0);
}

TEST_F(SubspaceTest, AnOptimalStartKeepsItsBits) {
  const Vector minimum = problem.chain().wave(1.0);
  for (const double rounding : {0.0, 2e-16}) {
    const Vector nearly = minimum * (1.0 + rounding);
    Vector x = nearly;
    const Report report = minimize(x);
    EXPECT_EQ(report.termination, Termination::kAlreadyOptimal) << report.message;
    EXPECT_TRUE(x == nearly);
  }
}

TEST_F(SubspaceTest, CancellingOnTheWayRestoresTheStart) {
  Progress progress;
  progress.cancel();
  Vector x = start;
  EXPECT_EQ(minimize(x, &progress).termination, Termination::kCancelled);
  EXPECT_TRUE(x == start);
}

}  // namespace
}  // namespace reflines

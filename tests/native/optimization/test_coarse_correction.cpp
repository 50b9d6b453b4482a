// A far minimum is approached with a stand-in of few unknowns, and found with fewer factors.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <thread>

#include "least_squares.h"
#include "optimization/minimizer.h"

namespace reflines {
namespace {

// The chain along smooth motions P: E(x + P c), by the Galerkin projection.
class CoarseChain final : public CoarseProblem {
 public:
  CoarseChain(Chain& chain, const SparseMatrix& modes, Vector x) : chain_(chain), modes_(modes), x_(std::move(x)) {}

  int size() const override { return static_cast<int>(modes_.rows()); }
  double evaluate(const Vector& c, Vector* gradient) override {
    Vector whole(x_.size());
    const double energy = chain_.evaluate(x_ + modes_.transpose() * c, &whole);
    if (gradient) *gradient = modes_ * whole;
    return energy;
  }
  const SparseMatrix& hessian(const Vector& c, HessianModel model) override {
    const SparseMatrix whole = chain_.hessian(x_ + modes_.transpose() * c, model).selfadjointView<Eigen::Lower>();
    hessian_ = SparseMatrix(modes_ * whole * modes_.transpose()).triangularView<Eigen::Lower>();
    return hessian_;
  }
  void move(const Vector& c, Vector& x) const override { x += modes_.transpose() * c; }

 private:
  Chain& chain_;
  const SparseMatrix& modes_;
  const Vector x_;
  SparseMatrix hessian_;
};

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
    pattern_ = chain_.hessian(Vector::Zero(size), HessianModel::kGaussNewton);
  }
  Chain& chain() { return chain_; }
  void withhold_motions() { offers_ = false; }

  std::thread::id ordering_thread() const { return ordering_thread_; }  // that asked for places; none: nobody did

  int size() const override { return chain_.size(); }
  double evaluate(const Vector& x, Vector* gradient) override { return chain_.evaluate(x, gradient); }
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override { return chain_.hessian(x, model); }
  const SparseMatrix* pattern() override { return &pattern_; }
  PlanePositions places() override {
    ordering_thread_ = std::this_thread::get_id();
    return {};
  }
  std::unique_ptr<CoarseProblem> coarse(const Vector& x, const Vector&) override {
    return offers_ ? std::make_unique<CoarseChain>(chain_, modes_, x) : nullptr;
  }

 private:
  Chain chain_;
  SparseMatrix modes_, pattern_;
  bool offers_ = true;
  std::thread::id ordering_thread_;
};

struct ApproachTest : testing::Test {
  ApproachTest() : problem(120, 2.0, 8, 12), start(Vector::Zero(120)) {
    problem.chain().set_minimum(problem.chain().wave(1.0));
  }
  Report minimize(Vector& x, Progress* progress = nullptr) { return Minimizer().minimize(problem, x, {}, progress); }

  SmoothChain problem;
  Vector start;
};

TEST_F(ApproachTest, AFarMinimumTakesFewerFactors) {
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

// What the stand-in costs of the whole problem is one evaluation: no assembly, no factor.
TEST_F(ApproachTest, TheApproachIsOneEvaluation) {
  Vector x = start;
  const Report report = minimize(x);
  ASSERT_GT(report.coarse_iterations, 0);
  EXPECT_EQ(report.assemblies, report.factorizations);
  EXPECT_EQ(report.analyses, 1);
  EXPECT_GE(report.evaluations, report.iterations + 2);
}

// A large system is analysed meanwhile in another thread, once, and the steps are those of one thread.
TEST_F(ApproachTest, TheAnalysisRunsBesideIt) {
  Vector ends[2];
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    SmoothChain large(3000, 0.2, 60, 90);
    large.chain().set_minimum(large.chain().wave(1.0));
    ends[threads - 1] = large.chain().wave(0.9);
    const Report report = Minimizer().minimize(large, ends[threads - 1], {});
    EXPECT_TRUE(report.converged()) << report.message;
    EXPECT_EQ(report.analyses, 1);
    EXPECT_NE(large.ordering_thread(), std::thread::id());
    EXPECT_EQ(large.ordering_thread() == std::this_thread::get_id(), threads == 1);
  }
  omp_set_num_threads(before);
  EXPECT_TRUE(ends[0] == ends[1]);
}

// A zigzag does not yield to smooth motions: they are given up after one step, and nothing of it remains.
TEST_F(ApproachTest, IsGivenUpWhereItDoesNotHelp) {
  Vector zigzag = problem.chain().wave(1.0);
  for (int k = 0; k < 120; ++k) zigzag[k] += k % 2 == 0 ? 1e-3 : -1e-3;
  const Report report = minimize(zigzag);
  EXPECT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.coarse_iterations, 0);
}

TEST_F(ApproachTest, AnOptimalStartKeepsItsBits) {
  const Vector minimum = problem.chain().wave(1.0);
  for (const double rounding : {0.0, 2e-16}) {
    const Vector nearly = minimum * (1.0 + rounding);
    Vector x = nearly;
    const Report report = minimize(x);
    EXPECT_EQ(report.termination, Termination::kAlreadyOptimal) << report.message;
    EXPECT_TRUE(x == nearly);
  }
}

TEST_F(ApproachTest, CancellingOnTheWayRestoresTheStart) {
  Progress progress;
  progress.cancel();
  Vector x = start;
  EXPECT_EQ(minimize(x, &progress).termination, Termination::kCancelled);
  EXPECT_TRUE(x == start);
}

}  // namespace
}  // namespace reflines

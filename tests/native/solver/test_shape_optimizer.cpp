// What a solve costs, in counts: the same on every machine.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "reflines/errors.h"
#include "reflines/shape_optimizer.h"
#include "solver/optimizer_internals.h"
#include "tests/native/allocations.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

double cylinder(double x, double) { return std::sqrt(1 - (x - 0.5) * (x - 0.5)); }

double bump(double x, double y) {
  const double rest = 1 - 9 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5));
  return rest > 0 ? 0.03 * rest * rest * rest * rest : 0.0;
}

// A bump on a cylinder; the wanted lines are those of the cylinder with another bump.
struct ShapeOptimizerTest : testing::Test {
  static samples::Mesh mesh(double scale) {
    return samples::lifted(samples::grid(24, 0.2),
                           [scale](double x, double y) { return cylinder(x, y) + scale * bump(x, y); });
  }
  static std::unique_ptr<ShapeOptimizer> optimizer(double scale) {
    const samples::Mesh own = mesh(scale);
    return std::make_unique<ShapeOptimizer>(own.V, own.F, Vector3::UnitZ(), std::vector<Vector3>{{0, 1, 0.3}});
  }
  static Target target(double scale) {
    Target target;
    target.gradient = optimizer(scale)->field(0);
    return target;
  }
};

TEST_F(ShapeOptimizerTest, BumpIsTakenAwayWithOneFactor) {
  const auto solver = optimizer(1.0);
  const Report report = solver->solve({target(0.0)});
  ASSERT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.analyses, 1);
  EXPECT_EQ(report.assemblies, 1);
  EXPECT_EQ(report.factorizations, 1);
  EXPECT_EQ(report.solves, report.iterations);
  EXPECT_LE(report.iterations, 12);
  EXPECT_LT((solver->heights() - optimizer(0.0)->heights()).cwiseAbs().maxCoeff(), 1e-4 * 0.03);
}

// Seen from afar first, a bump over many vertices takes one evaluation to approach, one matrix, and a few steps.
TEST_F(ShapeOptimizerTest, AWideBumpIsApproachedFromAfar) {
  const auto wide = [](double scale) {
    const samples::Mesh own = samples::lifted(
        samples::grid(64, 0.2), [scale](double x, double y) { return cylinder(x, y) + scale * bump(x, y); });
    return ShapeOptimizer(own.V, own.F, Vector3::UnitZ(), {{0, 1, 0.3}});
  };
  for (const double start : {1.0, 0.0}) {
    ShapeOptimizer solver = wide(start);
    Target wanted;
    wanted.gradient = wide(1.0 - start).field(0);
    const Report report = solver.solve({wanted});
    ASSERT_TRUE(report.converged()) << report.message;
    EXPECT_GT(report.coarse_iterations, 0);
    EXPECT_EQ(report.assemblies + report.analyses + report.factorizations, 3);
    EXPECT_EQ(report.evaluations, report.iterations + 2);
    EXPECT_LE(report.iterations, 4);
  }
}

TEST_F(ShapeOptimizerTest, WarmUpdateAnalysesAssemblesAndFactorsNothing) {
  const auto solver = optimizer(0.4);
  solver->solve({target(0.5)});
  MinimizerOptions drag;
  drag.gradient_tolerance = 1e-2;
  const Report report = solver->solve({target(0.45)}, drag);
  ASSERT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.analyses + report.assemblies + report.factorizations, 0);
  EXPECT_LE(report.iterations, 2);
  EXPECT_EQ(report.evaluations, report.iterations + 1);
}

TEST_F(ShapeOptimizerTest, StepsAllocateNothing) {
  if (!kAllocationsAreCounted) GTEST_SKIP() << "this build's malloc cannot be counted";
  const auto solver = optimizer(0.4);
  solver->solve({target(0.5)});
  std::int64_t used[2];
  for (int run = 0; run < 2; ++run) {
    const std::vector<Target> targets = {target(0.6 + 0.1 * run)};
    MinimizerOptions options;
    options.gradient_tolerance = 0.0;
    options.max_iterations = run == 0 ? 1 : 3;
    const std::int64_t before = allocations.load();
    const Report report = solver->solve(targets, options);
    used[run] = allocations.load() - before;
    ASSERT_EQ(report.iterations, options.max_iterations) << report.message;
    ASSERT_EQ(report.factorizations, 0);
  }
  EXPECT_EQ(used[0], used[1]);
}

TEST_F(ShapeOptimizerTest, AFailedSolveChangesNoBitOfTheHeights) {
  const samples::Mesh own = mesh(1.0);
  ShapeOptions options;
  options.border.assign(own.V.rows(), Border::kFree);
  ShapeOptimizer solver(own.V, own.F, Vector3::UnitZ(), {{0, 1, 0.3}}, options);
  ASSERT_GT(solver.solve({target(0.5)}).largest_move, 0.0);
  const Vector before = solver.heights();
  Target runaway;
  runaway.gradient = PlaneVectors::Constant(solver.triangle_count(), 2, 1e6);
  EXPECT_THROW(solver.solve({runaway}), SolverFailure);
  EXPECT_EQ(solver.heights(), before);
}

TEST_F(ShapeOptimizerTest, StaysNearTheHeightsGivenUntilAReset) {
  const samples::Mesh bumped = mesh(1.0);
  ShapeOptions options;
  options.proximity = 1e12;  // the target has no say beside it
  ShapeOptimizer solver(bumped.V, bumped.F, Vector3::UnitZ(), {{0, 1, 0.3}}, options);
  const Vector start = solver.heights(), wanted = optimizer(0.5)->heights();
  solver.stay_near(wanted);
  ASSERT_TRUE(solver.solve({target(0.0)}).converged());
  EXPECT_LT((solver.heights() - wanted).cwiseAbs().maxCoeff(), 1e-3 * 0.03);
  solver.reset();
  solver.solve({target(0.0)});
  EXPECT_LT((solver.heights() - start).cwiseAbs().maxCoeff(), 1e-3 * 0.03);
  EXPECT_THROW(solver.stay_near(start.head(start.size() - 1)), InvalidInput);
  EXPECT_THROW(solver.stay_near(Vector::Constant(start.size(), std::nan(""))), InvalidInput);
}

TEST_F(ShapeOptimizerTest, HandsOutTheMatrixThatASolveFactors) {
  const auto solver = optimizer(1.0);
  const std::vector<Target> targets = {target(0.0)};
  const SparseMatrix H = solver->internals().hessian(targets, HessianModel::kGaussNewton);
  ASSERT_EQ(H.rows(), solver->region().free);
  // At the minimum itself the energy's second difference along any direction is that of Gauss-Newton.
  solver->solve(targets, {.gradient_tolerance = 1e-12});
  const SparseMatrix at_minimum = solver->internals().hessian(targets, HessianModel::kGaussNewton);
  const SparseMatrix newton = solver->internals().hessian(targets, HessianModel::kNewton);
  EXPECT_LT((at_minimum - newton).norm(), 1e-3 * newton.norm());
  EXPECT_GT((H - newton).norm(), 1e-2 * newton.norm());  // far from it they differ
}

}  // namespace
}  // namespace reflines

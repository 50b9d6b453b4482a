// The usual fairing of the same region: a biharmonic system for the three coordinates.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <vector>

#include "optimization/linear/linear_solver.h"
#include "tests/bench/bench.h"
#include "tests/bench/bump_cylinder.h"

namespace reflines::bench {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

struct CotangentLaplacian {
  SparseMatrix L;       // #V x #V, positive semi-definite
  Vector inverse_mass;  // #V: 1 / a third of the area around each vertex
};

CotangentLaplacian cotangent_laplacian(const Positions& V, const Triangles& F) {
  Triplets entries;
  entries.reserve(12 * F.rows());
  Vector mass = Vector::Zero(V.rows());
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int o = F(t, i), a = F(t, (i + 1) % 3), b = F(t, (i + 2) % 3);
      const Vector3 p = (V.row(a) - V.row(o)).transpose(), q = (V.row(b) - V.row(o)).transpose();
      const double doubled_area = p.cross(q).norm(), half_cotangent = 0.5 * p.dot(q) / doubled_area;
      mass(o) += doubled_area / 6;
      entries.emplace_back(a, a, half_cotangent);
      entries.emplace_back(b, b, half_cotangent);
      entries.emplace_back(a, b, -half_cotangent);
      entries.emplace_back(b, a, -half_cotangent);
    }
  }
  CotangentLaplacian result{SparseMatrix(V.rows(), V.rows()), mass.cwiseInverse()};
  result.L.setFromTriplets(entries.begin(), entries.end());
  return result;
}

// Columns of the free vertices: a selection matrix #V x n.
SparseMatrix selection(const Mask& is_free) {
  Triplets entries;
  for (int v = 0; v < is_free.size(); ++v) {
    if (is_free(v)) entries.emplace_back(v, static_cast<int>(entries.size()), 1.0);
  }
  SparseMatrix S(is_free.size(), static_cast<Eigen::Index>(entries.size()));
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

// min |M^-1/2 L V|^2 over the free vertices: (S^T L M^-1 L S) X = -S^T L M^-1 L V_held.
Positions fair(const Positions& V, const Triangles& F, const Mask& is_free) {
  const CotangentLaplacian laplacian = cotangent_laplacian(V, F);
  const SparseMatrix S = selection(is_free), LS = laplacian.L * S;
  const SparseMatrix MLS = laplacian.inverse_mass.asDiagonal() * LS;
  const SparseMatrix Q = SparseMatrix(LS.transpose() * MLS).triangularView<Eigen::Lower>();
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(Q);
  solver.factorize(Q);
  Positions result = V;
  for (int k = 0; k < 3; ++k) {
    Vector step = -(MLS.transpose() * (laplacian.L * V.col(k)));
    solver.solve(step);
    result.col(k) += S * step;
  }
  return result;
}

void biharmonic(benchmark::State& state, int unknowns) {
  const BumpCylinder problem(cells_for_unknowns(unknowns));
  const Positions V = problem.positions(1.0);
  const Mask is_free = problem.optimizer(1.0)->free();
  for (auto _ : state) benchmark::DoNotOptimize(fair(V, problem.triangles(), is_free));
  state.counters["unknowns"] = static_cast<double>(is_free.count());
}

}  // namespace

void register_biharmonic() {
  benchmark::RegisterBenchmark("biharmonic/100k", biharmonic, 100000)
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace reflines::bench

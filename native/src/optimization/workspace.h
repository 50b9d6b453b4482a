// The state that a Minimizer keeps between solves: the factor, the L-BFGS pairs and the vectors of the loop.
#pragma once

#include "optimization/bounds.h"
#include "optimization/linear/dissection.h"
#include "optimization/linear/linear_solver.h"
#include "optimization/problem.h"
#include "optimization/quasi_newton.h"
#include "reflines/types.h"

namespace reflines {

struct Workspace {
  explicit Workspace(LinearSolverKind kind) : solver(kind) {}

  LinearSolver solver;
  HessianModel factored_model = HessianModel::kGaussNewton;
  QuasiNewtonMemory memory;      // pairs seen since that factor was made
  Vector rounding_weight;        // of the matrix last assembled, see Problem
  Vector x, gradient;            // the current point
  Vector trial, trial_gradient;  // the point being tried
  Vector direction;

  // Within bounds only.
  SparseMatrix matrix;  // the model's, whole
  Sides held;           // n: the factor leaves their rows and columns out; empty: it is one of the whole matrix

  bool has_factor_of(HessianModel model, Eigen::Index n) const {
    return solver.has_factor() && held.empty() && factored_model == model && rounding_weight.size() == n;
  }
  bool has_bounded_factor_of(HessianModel model, Eigen::Index n) const {
    return solver.has_factor() && factored_model == model && static_cast<Eigen::Index>(held.size()) == n;
  }

  // Reads no values of the matrix. Returns the number of analyses made, 0 where the pattern is known.
  int analyze(const SparseMatrix& matrix, Problem& problem) {
    if (solver.has_pattern_of(matrix)) return 0;
    const PlanePositions places = problem.places();
    solver.analyze(matrix, places.rows() > 0 ? dissection_order(matrix, places) : std::vector<int>());
    return 1;
  }

  // No-op for the same n: then nothing is allocated in a second solve.
  void resize(Eigen::Index n) {
    if (x.size() == n) return;
    for (Vector* vector : {&x, &gradient, &trial, &trial_gradient, &direction}) vector->resize(n);
    memory.resize(n);
  }
};

}  // namespace reflines

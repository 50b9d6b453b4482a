// What a Minimizer keeps between solves: the factor, what was learnt since, and every vector the loop needs.
#pragma once

#include "native/optimization/linear_solver.h"
#include "native/optimization/problem.h"
#include "native/optimization/quasi_newton.h"
#include "native/types.h"

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

  bool has_factor_of(HessianModel model, Eigen::Index n) const {
    return solver.has_factor() && factored_model == model && rounding_weight.size() == n;
  }

  // No-op for the same n: then nothing is allocated in a second solve.
  void resize(Eigen::Index n) {
    if (x.size() == n) return;
    for (Vector* vector : {&x, &gradient, &trial, &trial_gradient, &direction}) vector->resize(n);
    memory.resize(n);
  }
};

}  // namespace reflines

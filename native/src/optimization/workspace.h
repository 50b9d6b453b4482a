// The state that a Minimizer keeps between solves: the factor, the L-BFGS pairs and the vectors of the loop.
#pragma once

#include "optimization/bounds.h"
#include "optimization/held_factor.h"
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

  // The state of a bounded minimization.
  SparseMatrix matrix;  // the whole matrix of the model
  Sides held;           // n: unknowns that held_factor holds; empty: the solver's factor is one of the whole matrix
  HeldFactor held_factor{solver};
  bool many_contacts = false;  // see minimize_bounded
  int usual_steps = 1;         // of a minimization at whose start the matrix was assembled
  int extra_steps = 0;         // beyond these of each minimization since

  bool has_factor_of(HessianModel model, Eigen::Index n) const {
    return solver.has_factor() && held.empty() && factored_model == model && rounding_weight.size() == n;
  }
  bool has_bounded_factor_of(HessianModel model, Eigen::Index n) const {
    return solver.has_factor() && held_factor.is_current() && factored_model == model &&
           static_cast<Eigen::Index>(held.size()) == n;
  }

  // Forgets what solves left for later ones, but for the analysis, which depends on the pattern alone.
  void forget_factor() {
    solver.forget_factor();
    held_factor.forget();
    held.clear();
    memory.clear();
    many_contacts = false;
    usual_steps = 1;
    extra_steps = 0;
  }

  // Analyses the pattern of the matrix, whose values are not read. Returns the number of analyses made, 0 where the
  // pattern is known. Throws Cancelled.
  int analyze(const SparseMatrix& matrix, Problem& problem, const Progress* progress) {
    if (solver.has_pattern_of(matrix)) return 0;
    const PlanePositions places = problem.places();
    const auto order = places.rows() > 0 ? dissection_order(matrix, places, progress) : std::vector<int>();
    solver.analyze(matrix, order, progress);
    return 1;
  }

  // Resizes the vectors; does nothing for the same n, so that a second solve allocates nothing.
  void resize(Eigen::Index n) {
    if (x.size() == n) return;
    for (Vector* vector : {&x, &gradient, &trial, &trial_gradient, &direction}) vector->resize(n);
    memory.resize(n);
  }
};

}  // namespace reflines

// The linear system of a fairing: heights of least variation of curvature, near given ones in height and slope.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "optimization/linear/linear_solver.h"
#include "reflines/progress.h"
#include "reflines/smooth_panel.h"
#include "reflines/types.h"
#include "restoration/curvature_variation.h"

namespace reflines {

class FairingSystem {
 public:
  explicit FairingSystem(const CurvatureVariation& variation);  // which outlives it

  // Factors the system of the moves m of the free vertices that minimise
  //   E(z + m) + sum_v A_v m_v^2 + sum_T A_T s_T |grad m|^2,
  // where E is the variation of curvature with these weights of the edges, A_v a third of the area around v, and s
  // (#T) the weight of slopes, length^2. `progress` may be null; throws Cancelled.
  void factorize(const EdgeWeights& weight, const Vector& slope, const Progress* progress);

  // Returns z + m (#V) for heights z (#V), by the last factor.
  Vector smooth(const Vector& z);

  // Returns the work since the last call.
  PressWork take_work() { return std::exchange(work_, {}); }

 private:
  void build_pattern(const Progress* progress);
  struct Workspace;
  void add_vertex(int v, Workspace& space) const;
  void add_slopes(int v, Workspace& space) const;
  void fill_columns(SparseMatrix& A) const;

  const CurvatureVariation& variation_;
  std::vector<int> column_;  // #V: the unknown of each free vertex, -1
  std::vector<int> vertex_;  // of each unknown
  Vector area_;              // #V
  EdgeWeights scaled_;       // of the last factor
  Vector slope_;             // #T, times the area
  SparseMatrix pattern_;     // lower triangle
  std::unique_ptr<LinearSolver> solver_;
  PressWork work_;
};

}  // namespace reflines

// L-BFGS (Nocedal and Wright, algorithm 7.4) whose initial Hessian is a factored sparse matrix.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// The memory of L-BFGS pairs. Usage: d = -g; memory.before_solve(d); solver.solve(d); memory.after_solve(d) leaves the
// quasi-Newton direction in d.
class QuasiNewtonMemory {
 public:
  // Allocates work space for vectors of length n and drops all pairs.
  void resize(Eigen::Index n);
  void clear() { count_ = 0; }

  void before_solve(Vector& direction);
  void after_solve(Vector& direction) const;

  // Adds the pair (x_new - x, g_new - g) unless its curvature is negative, and drops the oldest of 8.
  void learn(const Vector& step, const Vector& gradient_change);

 private:
  struct Pair {
    Vector step, gradient_change;
    double curvature = 0.0;  // step . gradient_change
    double weight = 0.0;     // weight of the pair in the current direction
  };
  Pair& pair(int age) { return pairs_[(newest_ + pairs_.size() - age) % pairs_.size()]; }
  const Pair& pair(int age) const { return pairs_[(newest_ + pairs_.size() - age) % pairs_.size()]; }

  std::vector<Pair> pairs_;
  std::size_t newest_ = 0;
  int count_ = 0;
};

}  // namespace reflines

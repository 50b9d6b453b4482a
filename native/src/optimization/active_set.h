// The interface of limits to a descent: the functions that touch the ends of their ranges, and steps along these.
#pragma once

#include <optional>

#include "optimization/quasi_newton.h"
#include "reflines/types.h"

namespace reflines {

// The limits of one run at the point and with the matrix of its Workspace. Throws Cancelled where it solves.
class ActiveSet {
 public:
  virtual ~ActiveSet() = default;

  virtual int count_beyond(const Vector& x) const = 0;
  virtual bool contain(const Vector& x) const = 0;
  virtual bool may_move() const = 0;                        // false where all unknowns are held
  virtual Vector move_inside(const Vector& x) const = 0;    // a point within the limits; x where it is one
  virtual Vector keep_inside(Vector x) const { return x; }  // of a point between two that are within the limits

  // Prepares for the way to a free minimum beyond the limits, and returns the farthest point on the way from x.
  virtual void aim_at(const Vector& minimum) = 0;
  virtual Vector go_towards(const Vector& minimum, const Vector& x) const = 0;

  // Returns whether the workspace has a matrix and a factor of an earlier run.
  virtual bool has_factor(HessianModel model) const = 0;
  virtual void forget_factor() {}  // the matrix is another
  // Returns whether each step takes a new matrix.
  virtual bool renews_each_step() const { return false; }

  // Returns the norm of the gradient without the forces of the contacts: 0 at a minimum.
  virtual double measure_gradient() = 0;

  // Returns the end of a step with the present factor and set, or nothing where others are needed; `left` is the
  // gradient measured last. `memory` may be null.
  virtual std::optional<Vector> lead_on(double left, QuasiNewtonMemory* memory) = 0;

  // Determines the set anew, and returns the end of the step to the model's minimum: down to `wanted`, where only a
  // number of solves leads there.
  virtual Vector solve_model(double wanted) = 0;

  // Prepares a pair for the quasi-Newton memory; returns false where it is none of the free unknowns.
  virtual bool prepare_pair(const Vector& step, Vector& change) const = 0;
};

}  // namespace reflines

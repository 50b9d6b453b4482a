// A quadratic model g.d + d.H d / 2 of an energy, minimized within limits of many linear functions of few unknowns.
#pragma once

#include <optional>
#include <vector>

#include "optimization/border_columns.h"
#include "optimization/held_factor.h"
#include "optimization/row_limits.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/types.h"

namespace reflines {

// A limit that holds a function at an end of its range.
struct Contact {
  int row;
  Side side;

  double sign() const { return side == Side::kLow ? 1.0 : -1.0; }  // of its force on the function
  bool operator==(const Contact&) const = default;
};
using Contacts = std::vector<Contact>;

// The quadratic program is solved by cutting planes on its dual: from the free minimum on, functions at the peaks of
// the violation are held, and the forces of all that are held are those of the small program with these alone, so that
// those that pull are let go. The value of the small programs grows from round to round, which ends the search at the
// minimum. All they need of H is its factor: the forces act through A H^-1 A^T, of which each contact costs one solve.
class ContactQuadratic {
 public:
  // Takes the factor of H that leaves out what `limits` hold, and the solver that has it; all outlive this. `counts`
  // collects solves; `progress` may be null.
  ContactQuadratic(const RowLimits::Narrow& limits, HeldFactor& factor, LinearSolver& solver, Report& counts,
                   Progress* progress)
      : rows_(limits.rows), factor_(factor), counts_(counts), progress_(progress), known_(solver, false) {}

  // Tells that the factor has become another.
  void forget() { known_.clear(); }

  // Returns d with a violation of low <= A d <= high of at most `tolerance`, or nothing where there are too many
  // contacts for this method. `contacts` is an estimate. Throws Cancelled.
  struct Minimum {
    Vector d;
    Contacts contacts;  // those with a force
  };
  std::optional<Minimum> minimize(const Vector& gradient, const Vector& low, const Vector& high, double tolerance,
                                  Contacts contacts);

  // Returns the step to the minimum with the contacts held that moves their functions into their range by `change`
  // (#contacts).
  Vector step_along(const Contacts& contacts, const Vector& gradient, const Vector& change, double tolerance);

  // Returns how far the contacts' functions are moved into their range (#contacts) by d, or by the way to their ends.
  Vector changes(const Contacts& contacts, const Vector& d) const;
  Vector ends(const Contacts& contacts, const Vector& low, const Vector& high) const;

  // Returns the forces (#contacts, > 0 where the contact presses) that balance the gradient best in the norm of H^-1.
  Vector find_forces(const Contacts& contacts, const Vector& gradient);

  // Returns the gradient of which the forces are taken off: 0 at a minimum.
  Vector take_off(const Contacts& contacts, const Vector& forces, const Vector& gradient) const;

 private:
  Vector solve(Vector right);
  std::vector<int> find_known(const Contacts& contacts);
  Eigen::MatrixXd compliance(const Contacts& contacts);
  Vector refine(const Contacts& contacts, const Vector& wanted, double tolerance, Vector d);
  Contacts find_peaks(const Vector& low, const Vector& high, double tolerance, const Vector& d) const;

  const SparseMatrix& rows_;
  HeldFactor& factor_;
  Report& counts_;
  Progress* progress_;
  BorderColumns known_;  // rows of A that were contacts since the factorization, and their products A H^-1 A^T
};

// Solves S y >= c, y >= 0, y (S y - c) = 0 for a positive definite S by block principal pivoting (Judice and Pires,
// Comput. Oper. Res. 21, 1994), from the estimate that all are positive.
struct Complementarity {
  Vector y;
  std::vector<bool> positive;  // where y may be > 0
};
Complementarity solve_complementarity(const Eigen::MatrixXd& S, const Vector& c, double tolerance);

}  // namespace reflines

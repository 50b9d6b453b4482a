// A quadratic model g.d + d.H d / 2 of an energy, minimized within limits of many functions that few of them touch.
#pragma once

#include <vector>

#include "optimization/border_columns.h"
#include "optimization/bounds.h"
#include "optimization/quadratic_model.h"
#include "optimization/row_limits.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// The quadratic program is solved by cutting planes on its dual: from the free minimum on, functions at the peaks of
// the violation are held, and the forces of all that are held are those of the small program with these alone, so that
// those that pull are let go (as Goldfarb and Idnani do one by one, Math. Program. 27, 1983). The value of the small
// programs grows from round to round, which ends the search at the minimum. All they need of H is its factor: the
// forces act through A H^-1 A^T.
class ContactQuadratic {
 public:
  // Takes the columns beside a factor of H that leaves out what `limits` hold; both outlive this. `progress` may be
  // null.
  ContactQuadratic(const RowLimits::Narrow& limits, BorderColumns& known, Progress* progress)
      : limits_(limits), rows_(limits.rows), known_(known), progress_(progress) {}

  // Returns d within the tolerance of low <= A d <= high, or within bounds with a projected gradient as wanted; or what
  // it has come to where there are too many contacts for this method. `contacts` is an estimate. Throws Cancelled.
  struct Minimum {
    Vector d;
    Contacts contacts;  // those with a force
    bool complete;
  };
  Minimum minimize(const QuadraticModel& model, const Bounds& range, double wanted, Contacts contacts);

  // Returns the step along -gradient to the minimum with the contacts held that moves their functions into their range
  // by `change` (#contacts).
  Vector step_along(const Contacts& contacts, const Vector& gradient, const Vector& change, double tolerance);

  // Returns the way of the contacts' functions into their range (#contacts) that leads to their ends.
  static Vector ends(const Contacts& contacts, const Bounds& range);

  // Returns the forces (#contacts, > 0 where the contact presses) that balance the gradient best in the norm of H^-1.
  Vector find_forces(const Contacts& contacts, const Vector& gradient);

  // Returns the gradient of which the forces are taken off: 0 at a minimum.
  Vector take_off(const Contacts& contacts, const Vector& forces, const Vector& gradient) const;

 private:
  // The contacts' system S forces = change of their functions (#contacts), both > 0 into the range.
  struct System {
    Contacts contacts;
    std::vector<int> column;  // among the known ones
    Vector sign;
    Eigen::MatrixXd S;
  };
  size_t most_contacts() const;
  Minimum let_go(const Vector& gradient, const Bounds& range, double tolerance, const Contacts& contacts);
  System find_system(Contacts contacts);
  Vector free_changes(const System& system, const Vector& gradient);
  Vector changes(const System& system, const Vector& d) const;
  Vector border(const System& system, const Vector& forces) const;
  Vector finish(const System& system, const Vector& forces, const Vector& wanted, double tolerance);
  Contacts find_peaks(const SparseMatrix& H, const Bounds& range, double tolerance, const Vector& d) const;

  const RowLimits::Narrow& limits_;
  const SparseMatrix& rows_;
  BorderColumns& known_;  // rows of A that were contacts since the factorization, and their products A H^-1 A^T
  Progress* progress_;
};

// Solves S y >= c, y >= 0, y (S y - c) = 0 for a positive definite S by block principal pivoting (Judice and Pires,
// Comput. Oper. Res. 21, 1994), from the estimate that all are positive.
struct Complementarity {
  Vector y;
  std::vector<bool> positive;  // where y may be > 0
};
Complementarity solve_complementarity(const Eigen::MatrixXd& S, const Vector& c, double tolerance);

}  // namespace reflines

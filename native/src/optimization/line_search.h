// The acceptance test and the step reduction of a backtracking line search along a descent direction d.
#pragma once

namespace reflines {

// A point of the line search: the energy there and its derivative along the line, g . d.
struct LinePoint {
  double step = 0.0;  // t; 0 at x itself
  double energy = 0.0;
  double slope = 0.0;
};

// Returns whether Armijo's condition holds; where the energies agree to rounding, the slopes decide instead (Hager and
// Zhang's approximate Wolfe condition, SIAM J. Optim. 16, 2005). False where the trial is not finite.
bool lowers_energy_enough(const LinePoint& start, const LinePoint& trial);

// Returns a shorter step after a refused one: the minimum of the parabola through both, between a tenth and a half of
// it.
double shorter_step(const LinePoint& start, const LinePoint& trial);

}  // namespace reflines

#include "solver/solve_checks.h"

#include <cstdio>
#include <limits>
#include <string>

#include "reflines/errors.h"

namespace reflines {
namespace {

// The largest move in diagonals of the region. Lines that are hard to reach move a panel by a few per cent of its
// diagonal, absurd ones by half of it. Beyond this the step's own resolution grows with the heights, so that a solve
// "converges" at any size.
constexpr double kFarthest = 10.0;

}  // namespace

void check_quadrature_weight(const Vector& weight, Eigen::Index triangles) {
  if (weight.size() == 0) return;
  if (weight.size() != triangles) {
    throw InvalidInput("There are " + std::to_string(weight.size()) + " shares of the energy for " +
                       std::to_string(triangles) + " triangles; give one each, or none.");
  }
  if (weight.allFinite() && weight.minCoeff() >= 0) return;
  throw InvalidInput("A share of the energy is negative or not a finite number; give 0 or more.");
}

void check_reach(const Positions& V, const Triangles& F, double largest_move) {
  Eigen::RowVector3d low = V.row(F(0, 0)), high = low;
  for (const int v : F.reshaped()) {
    low = low.cwiseMin(V.row(v));
    high = high.cwiseMax(V.row(v));
  }
  const double diagonal = (high - low).norm();
  const double farthest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff() + largest_move;
  if (largest_move <= kFarthest * diagonal && farthest < std::numeric_limits<float>::max()) return;
  char move[64];
  std::snprintf(move, sizeof move, "%.3g", largest_move / diagonal);
  throw SolverFailure("The lines asked for would move the surface by " + std::string(move) +
                      " times its own size, so nothing was changed; ask for less strength or density, or hold more of "
                      "the border (Clamped).");
}

}  // namespace reflines

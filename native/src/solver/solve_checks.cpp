#include "solver/solve_checks.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "reflines/errors.h"

namespace reflines {
namespace {

// The largest move in diagonals of the region. Lines that are hard to attain move a panel by a few per cent of its
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

void check_face_of_triangle(const IndexVector& face, Eigen::Index triangles) {
  if (face.size() == 0 || face.size() == triangles) return;
  throw InvalidInput("There are " + std::to_string(face.size()) + " faces for " + std::to_string(triangles) +
                     " triangles; give the one that each was cut from, or none.");
}

void check_marked_creases(const Edges& creases, Eigen::Index vertices) {
  const auto beyond = (creases.array() < 0 || creases.array() >= vertices).rowwise().any().count();
  if (beyond == 0) return;
  throw InvalidInput(std::to_string(beyond) + " of the " + std::to_string(creases.rows()) +
                     " marked creases name a vertex beyond the " + std::to_string(vertices) + " of the region.");
}

void check_proximity(double proximity) {
  if (std::isfinite(proximity)) return;
  throw InvalidInput("The proximity is not a finite number; give 0 or more, or -1 for the usual one.");
}

void check_surroundings(const Surroundings& around, Eigen::Index vertices) {
  const Eigen::Index count = vertices + around.V.rows();
  if (around.F.size() > 0 && (around.F.minCoeff() < 0 || around.F.maxCoeff() >= count)) {
    throw InvalidInput("The triangles around the region name a vertex beyond the " + std::to_string(count) +
                       " of the region and around it.");
  }
  const auto finite = around.V.array().isFinite().rowwise().all().count();
  if (finite == around.V.rows()) return;
  throw InvalidInput(std::to_string(around.V.rows() - finite) +
                     " vertices around the region have a coordinate that is not a finite number.");
}

void check_move_size(const Eigen::AlignedBox3d& region, double largest_move) {
  const double diagonal = region.diagonal().norm();
  const double farthest = region.min().cwiseAbs().cwiseMax(region.max().cwiseAbs()).maxCoeff() + largest_move;
  if (largest_move <= kFarthest * diagonal && farthest < std::numeric_limits<float>::max()) return;
  char move[64];
  std::snprintf(move, sizeof move, "%.3g", largest_move / diagonal);
  throw SolverFailure("The lines asked for would move the surface by " + std::string(move) +
                      " times its own size, so nothing was changed; ask for less strength or density, or hold more of "
                      "the border.");
}

}  // namespace reflines

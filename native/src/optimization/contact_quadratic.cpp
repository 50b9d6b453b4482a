#include "optimization/contact_quadratic.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace reflines {
namespace {

constexpr int kMaxRounds = 200;

// The contacts, and their fraction of the unknowns, above which the search ends, for the small program takes their
// cube: of 1,927 unknowns 1,125 contacts take 5.1 s, and minimize_from_inside 2.7. Elimination, which bounds have, is
// quicker sooner.
constexpr double kMostContactFraction = 0.4, kMostHeldFraction = 0.03;
constexpr size_t kMostContacts = 800, kMostHeld = 256;

// The violation below which a peak is not yet held, relative to the largest, where there are many: most of these vanish
// with the larger ones.
constexpr double kLeastViolation = 0.05;
constexpr size_t kManyPeaks = 16;

// The part of the wanted gradient that a violation of a bound, which is cut off, may cost.
constexpr double kCutOff = 0.1;

// The relative softness of contacts, without which those of neighbours, whose functions are nearly equal, could not be
// known apart. Refinement takes back what it lets pass.
constexpr double kSoftness = 1e-11;
constexpr int kMaxRefinements = 5;

// The exchanges of whole blocks that may fail to lower the number of wrong signs before one sign after the other is
// changed, which cannot cycle.
constexpr int kPatience = 3;

std::vector<int> list(const std::vector<bool>& chosen) {
  std::vector<int> result;
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i]) result.push_back(static_cast<int>(i));
  }
  return result;
}

// Returns the first of the unknowns with the largest weight in a function.
int find_heaviest(const SparseMatrix& rows, int function) {
  double most = 0.0;
  int heaviest = -1;
  for (SparseMatrix::InnerIterator entry(rows, function); entry; ++entry) {
    if (!(entry.value() > most)) continue;
    most = entry.value();
    heaviest = static_cast<int>(entry.row());
  }
  return heaviest;
}

Vector solve_softly(const Eigen::MatrixXd& S, const Vector& c) {
  Eigen::MatrixXd soft = S;
  soft.diagonal() *= 1.0 + kSoftness;
  return soft.llt().solve(c);
}

}  // namespace

Complementarity solve_complementarity(const Eigen::MatrixXd& S, const Vector& c, double tolerance) {
  std::vector<bool> positive(c.size(), true);
  int fewest = std::numeric_limits<int>::max(), patience = kPatience;
  const int most = 20 + 4 * static_cast<int>(c.size());
  Vector y = Vector::Zero(c.size());
  for (int exchange = 0; exchange < most; ++exchange) {
    const std::vector<int> in = list(positive);
    const Eigen::MatrixXd inner = S(in, in);
    y.setZero();
    y(in) = solve_softly(inner, c(in));
    const Vector missing = c - S * y;
    std::vector<int> wrong;
    for (int i = 0; i < c.size(); ++i) {
      if (positive[i] ? y(i) < 0 : missing(i) > tolerance) wrong.push_back(i);
    }
    if (wrong.empty()) break;
    const int count = static_cast<int>(wrong.size());
    if (count < fewest) {
      fewest = count;
      patience = kPatience;
    } else if (--patience < 0) {
      wrong = {wrong.back()};
    }
    for (const int i : wrong) positive[i] = !positive[i];
  }
  return {y.cwiseMax(0.0), std::move(positive)};
}

// Returns the contacts' system; new contacts are added to the known ones.
ContactQuadratic::System ContactQuadratic::find_system(Contacts contacts) {
  System result;
  std::vector<int> unknown;
  for (const Contact& contact : contacts) {
    if (known_.find(contact.row) < 0) unknown.push_back(contact.row);
  }
  if (limits_.are_bounds) unknown = known_.sort(std::move(unknown));
  if (!unknown.empty()) known_.add(unknown, select_columns(rows_, unknown), progress_);
  result.sign.resize(static_cast<Eigen::Index>(contacts.size()));
  for (size_t i = 0; i < contacts.size(); ++i) {
    result.column.push_back(known_.find(contacts[i].row));
    result.sign(static_cast<Eigen::Index>(i)) = contacts[i].sign();
  }
  result.S = result.sign.asDiagonal() * known_.products()(result.column, result.column) * result.sign.asDiagonal();
  result.contacts = std::move(contacts);
  return result;
}

// Returns how far the free minimum moves the contacts' functions into their range.
Vector ContactQuadratic::free_changes(const System& system, const Vector& gradient) {
  Vector right = -gradient;
  clear_held(limits_.held, right);
  return system.sign.cwiseProduct(Vector(known_.begin(right)(system.column)));
}

Vector ContactQuadratic::changes(const System& system, const Vector& d) const {
  Vector result = system.sign;
  for (size_t i = 0; i < system.contacts.size(); ++i)
    result(static_cast<Eigen::Index>(i)) *= rows_.col(system.contacts[i].row).dot(d);
  return result;
}

Vector ContactQuadratic::border(const System& system, const Vector& forces) const {
  Vector result = Vector::Zero(known_.count());
  result(system.column) = -system.sign.cwiseProduct(forces);
  return result;
}

// Returns the minimum with the contacts' forces, corrected for the differences from the wanted changes that softness
// and rounding left.
Vector ContactQuadratic::finish(const System& system, const Vector& forces, const Vector& wanted, double tolerance) {
  Vector d = known_.finish(border(system, forces));
  for (int k = 0; k < kMaxRefinements && wanted.size() > 0; ++k) {
    const Vector left = wanted - changes(system, d);
    if (left.cwiseAbs().maxCoeff() <= tolerance) break;
    d -= known_.respond(border(system, solve_softly(system.S, left)));
  }
  return d;
}

Vector ContactQuadratic::ends(const Contacts& contacts, const Bounds& range) {
  Vector result(static_cast<Eigen::Index>(contacts.size()));
  for (size_t i = 0; i < contacts.size(); ++i)
    result(static_cast<Eigen::Index>(i)) = contacts[i].sign() * range.end(contacts[i].row, contacts[i].side);
  return result;
}

Vector ContactQuadratic::take_off(const Contacts& contacts, const Vector& forces, const Vector& gradient) const {
  Vector result = gradient;
  for (size_t i = 0; i < contacts.size(); ++i) {
    const double force = contacts[i].sign() * forces(static_cast<Eigen::Index>(i));
    for (SparseMatrix::InnerIterator entry(rows_, contacts[i].row); entry; ++entry) {
      result(entry.row()) -= force * entry.value();
    }
  }
  return result;
}

Vector ContactQuadratic::find_forces(const Contacts& contacts, const Vector& gradient) {
  const System system = find_system(contacts);
  return -solve_softly(system.S, free_changes(system, gradient));
}

Vector ContactQuadratic::step_along(const Contacts& contacts, const Vector& gradient, const Vector& change,
                                    double tolerance) {
  const System system = find_system(contacts);
  return finish(system, solve_softly(system.S, change - free_changes(system, gradient)), change, tolerance);
}

size_t ContactQuadratic::most_contacts() const {
  const double fraction = limits_.are_bounds ? kMostHeldFraction : kMostContactFraction;
  return std::min(limits_.are_bounds ? kMostHeld : kMostContacts,
                  static_cast<size_t>(fraction * static_cast<double>(rows_.rows())));
}

ContactQuadratic::Minimum ContactQuadratic::minimize(const QuadraticModel& model, const Bounds& range, double wanted,
                                                     Contacts contacts) {
  const bool bounds = limits_.are_bounds;
  const double tolerance = bounds ? kCutOff * wanted / model.H.diagonal().maxCoeff() : 0.5 * limits_.tolerance;
  if (contacts.size() > most_contacts()) contacts.clear();
  Minimum result{{}, std::move(contacts), false};
  for (int round = 0; round < kMaxRounds && result.contacts.size() <= most_contacts(); ++round) {
    throw_if_cancelled(progress_);
    result = let_go(model.gradient, range, tolerance, result.contacts);
    if (bounds) {
      const Vector inside = range.nearest(result.d, result.contacts);
      if (range.projected_norm(inside, model.gradient_at(inside)) <= wanted) return {inside, result.contacts, true};
    }
    const size_t pressing = result.contacts.size();
    for (const Contact& peak : find_peaks(model.H, range, tolerance, result.d)) {
      if (std::find(result.contacts.begin(), result.contacts.end(), peak) == result.contacts.end())
        result.contacts.push_back(peak);
    }
    result.complete = result.contacts.size() == pressing;
    if (result.complete) break;
  }
  return result;
}

// Returns the minimum with those of the contacts that press on.
ContactQuadratic::Minimum ContactQuadratic::let_go(const Vector& gradient, const Bounds& range, double tolerance,
                                                   const Contacts& contacts) {
  const System all = find_system(contacts);
  const Complementarity pressed =
      solve_complementarity(all.S, ends(contacts, range) - free_changes(all, gradient), tolerance);
  Contacts pressing;
  for (const int i : list(pressed.positive)) pressing.push_back(contacts[i]);
  const Vector forces = pressed.y(list(pressed.positive));
  return {finish(find_system(pressing), forces, ends(pressing, range), 0.25 * tolerance), pressing, false};
}

// Returns the functions that are the farthest beyond their range of all those that depend on the unknown which counts
// most in them; of single unknowns, of all those that H couples to them.
Contacts ContactQuadratic::find_peaks(const SparseMatrix& H, const Bounds& range, double tolerance,
                                      const Vector& d) const {
  const Vector value = rows_.transpose() * d, beyond = (value - range.high).cwiseMax(range.low - value);
  std::vector<int> farthest(rows_.rows(), -1);
  const auto compare = [&](int k, int i) {
    if (farthest[k] < 0 || beyond(i) > beyond(farthest[k])) farthest[k] = i;
  };
  const SparseMatrix& coupling = limits_.are_bounds ? H : rows_;
  for (int i = 0; i < coupling.cols(); ++i) {
    for (SparseMatrix::InnerIterator entry(coupling, i); entry; ++entry) {
      const int k = static_cast<int>(entry.row());
      if (beyond(i) > tolerance) compare(k, i);
      if (limits_.are_bounds && beyond(k) > tolerance) compare(i, k);
    }
  }
  Contacts peaks;
  double most = 0.0;
  for (int k = 0; k < rows_.rows(); ++k) {
    const int i = farthest[k];
    if (i < 0 || find_heaviest(rows_, i) != k) continue;
    peaks.push_back({i, value(i) > range.high(i) ? Side::kHigh : Side::kLow});
    most = std::max(most, beyond(i));
  }
  if (limits_.are_bounds && peaks.size() > kManyPeaks)
    std::erase_if(peaks, [&](const Contact& peak) { return beyond(peak.row) < kLeastViolation * most; });
  return peaks;
}

}  // namespace reflines

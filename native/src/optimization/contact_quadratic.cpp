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
// cube: of 1,927 unknowns 1,125 contacts take 5.1 s, and InteriorPoint 2.7.
constexpr double kMostContactFraction = 0.4;
constexpr size_t kMostContacts = 800;

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

Vector ContactQuadratic::solve(Vector right) {
  counts_.solves += factor_.solve(right);
  return right;
}

// Returns the columns of the contacts among the known ones, to which new contacts are added.
std::vector<int> ContactQuadratic::find_known(const Contacts& contacts) {
  std::vector<int> result, wanted;
  std::vector<Eigen::Triplet<double>> entries;
  for (const Contact& contact : contacts) {
    result.push_back(known_.find(contact.row));
    if (result.back() >= 0) continue;
    result.back() = known_.count() + static_cast<int>(wanted.size());
    for (SparseMatrix::InnerIterator entry(rows_, contact.row); entry; ++entry) {
      entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(wanted.size()), entry.value());
    }
    wanted.push_back(contact.row);
  }
  if (wanted.empty()) return result;
  SparseMatrix columns(rows_.rows(), static_cast<Eigen::Index>(wanted.size()));
  columns.setFromTriplets(entries.begin(), entries.end());
  const int before = known_.solves();
  known_.add(wanted, columns, progress_);
  counts_.solves += known_.solves() - before;
  return result;
}

Eigen::MatrixXd ContactQuadratic::compliance(const Contacts& contacts) {
  const std::vector<int> known = find_known(contacts);
  Vector sign(static_cast<Eigen::Index>(contacts.size()));
  for (size_t i = 0; i < contacts.size(); ++i) sign(static_cast<Eigen::Index>(i)) = contacts[i].sign();
  return sign.asDiagonal() * known_.products()(known, known) * sign.asDiagonal();
}

// Returns the changes of the contacts' functions, > 0 into their range.
Vector ContactQuadratic::changes(const Contacts& contacts, const Vector& d) const {
  Vector result(static_cast<Eigen::Index>(contacts.size()));
  for (size_t i = 0; i < contacts.size(); ++i) {
    result(static_cast<Eigen::Index>(i)) = contacts[i].sign() * rows_.col(contacts[i].row).dot(d);
  }
  return result;
}

Vector ContactQuadratic::ends(const Contacts& contacts, const Vector& low, const Vector& high) const {
  Vector result(static_cast<Eigen::Index>(contacts.size()));
  for (size_t i = 0; i < contacts.size(); ++i) {
    const Contact& own = contacts[i];
    result(static_cast<Eigen::Index>(i)) = own.side == Side::kLow ? low(own.row) : -high(own.row);
  }
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
  return solve_softly(compliance(contacts), changes(contacts, solve(gradient)));
}

// Corrects a step with forces for the differences that softness and rounding left.
Vector ContactQuadratic::refine(const Contacts& contacts, const Vector& wanted, double tolerance, Vector d) {
  if (contacts.empty()) return d;
  const Eigen::MatrixXd S = compliance(contacts);
  for (int k = 0; k < kMaxRefinements; ++k) {
    const Vector left = wanted - changes(contacts, d);
    if (k > 0 && left.cwiseAbs().maxCoeff() <= tolerance) break;
    d -= solve(take_off(contacts, solve_softly(S, left), Vector::Zero(d.size())));
  }
  return d;
}

Vector ContactQuadratic::step_along(const Contacts& contacts, const Vector& gradient, const Vector& change,
                                    double tolerance) {
  return refine(contacts, change, tolerance, solve(-gradient));
}

std::optional<ContactQuadratic::Minimum> ContactQuadratic::minimize(const Vector& gradient, const Vector& low,
                                                                    const Vector& high, double tolerance,
                                                                    Contacts contacts) {
  const auto most =
      std::min(kMostContacts, static_cast<size_t>(kMostContactFraction * static_cast<double>(rows_.rows())));
  const Vector free = solve(-gradient);
  for (int round = 0; round < kMaxRounds; ++round) {
    throw_if_cancelled(progress_);
    const Vector missing = ends(contacts, low, high) - changes(contacts, free);
    const Complementarity pressed = solve_complementarity(compliance(contacts), missing, tolerance);
    Contacts pressing;
    for (size_t i = 0; i < contacts.size(); ++i) {
      if (pressed.positive[i]) pressing.push_back(contacts[i]);
    }
    Vector d = -solve(take_off(contacts, pressed.y, gradient));
    d = refine(pressing, ends(pressing, low, high), 0.25 * tolerance, d);
    contacts = pressing;
    for (const Contact& peak : find_peaks(low, high, tolerance, d)) {
      if (std::find(pressing.begin(), pressing.end(), peak) == pressing.end()) contacts.push_back(peak);
    }
    if (contacts.size() == pressing.size()) return Minimum{d, contacts};
    if (contacts.size() > most) break;
  }
  return {};
}

// Returns the functions that are the farthest beyond their range of all those that depend on the unknown which counts
// most in them.
Contacts ContactQuadratic::find_peaks(const Vector& low, const Vector& high, double tolerance, const Vector& d) const {
  const Vector value = rows_.transpose() * d;
  const auto beyond = [&](int i) { return std::max(value(i) - high(i), low(i) - value(i)); };
  std::vector<int> farthest(rows_.rows(), -1);
  for (int i = 0; i < rows_.cols(); ++i) {
    if (!(beyond(i) > tolerance)) continue;
    for (SparseMatrix::InnerIterator entry(rows_, i); entry; ++entry) {
      int& other = farthest[entry.row()];
      if (other < 0 || beyond(i) > beyond(other)) other = i;
    }
  }
  Contacts peaks;
  for (int k = 0; k < rows_.rows(); ++k) {
    const int i = farthest[k];
    if (i < 0 || find_heaviest(rows_, i) != k) continue;
    peaks.push_back({i, value(i) > high(i) ? Side::kHigh : Side::kLow});
  }
  return peaks;
}

}  // namespace reflines

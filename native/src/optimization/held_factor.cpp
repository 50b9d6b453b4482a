#include "optimization/held_factor.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace reflines {
namespace {

// The columns computed at once: those of 100,000 unknowns take 0.2 s, after which a cancellation is looked for.
constexpr int kBlock = 16;

void clear(const Sides& held, Vector& x) {
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (held[k] != Side::kBetween) x(k) = 0.0;
  }
}

}  // namespace

void HeldFactor::factorize(const SparseMatrix& H, const Sides& held, const Progress* progress, const Vector& added) {
  forget();
  inverse_.resize(0, 0);
  factored_ = held;
  matrix_ = H;
  for (int column = 0; column < H.cols(); ++column) {
    const bool column_held = held[column] != Side::kBetween;
    for (SparseMatrix::InnerIterator entry(matrix_, column); entry; ++entry) {
      if (entry.row() == column) {
        if (added.size() > 0) entry.valueRef() += added(column);
      } else if (column_held || held[entry.row()] != Side::kBetween) {
        entry.valueRef() = 0.0;
      }
    }
  }
  solver_.factorize(matrix_, progress);
  is_current_ = added.size() == 0;
}

void HeldFactor::forget() {
  is_current_ = false;
  contacts_.clear();
  known_.clear();
  half_.clear();
  lower_.resize(0);
}

// Returns the contacts, or nothing where they cannot be held by this factor.
std::optional<std::vector<int>> HeldFactor::find_contacts(const Sides& held) const {
  std::vector<int> contacts;
  if (!is_current_) return {};
  for (size_t k = 0; k < held.size(); ++k) {
    const bool left_out = factored_[k] != Side::kBetween;
    if (left_out == (held[k] != Side::kBetween)) continue;
    if (left_out) return {};
    contacts.push_back(static_cast<int>(k));
  }
  return contacts;
}

bool HeldFactor::leaves_out(const Sides& held) const {
  const std::optional<std::vector<int>> contacts = find_contacts(held);
  return contacts && contacts->empty() && contacts_.empty();
}

std::optional<int> HeldFactor::hold(const Sides& held, const Progress* progress) {
  std::optional<std::vector<int>> contacts = find_contacts(held);
  if (!contacts) return {};
  std::vector<int> column, wanted;
  for (const int k : *contacts) {
    const auto place = std::find(known_.begin(), known_.end(), k);
    column.push_back(static_cast<int>(place - known_.begin() + (place == known_.end() ? wanted.size() : 0)));
    if (place == known_.end()) wanted.push_back(k);
  }
  if (static_cast<int>(wanted.size()) > kMostNewContacts) return {};
  const int solves = add_known(wanted, progress);
  contacts_ = std::move(*contacts);
  schur_.compute(inverse_(column, column));
  column_ = std::move(column);
  return solves;
}

// Adds the rows and columns of the inverse of these unknowns; returns the number of solves that took.
int HeldFactor::add_known(const std::vector<int>& unknowns, const Progress* progress) {
  if (solver_.has_halves()) return add_halves(unknowns, progress), 0;
  add_columns(unknowns, progress);
  return static_cast<int>(unknowns.size());
}

// Computes the rows and columns as products of halves: A^-1 = (L^-1 P)^T L^-1 P.
void HeldFactor::add_halves(const std::vector<int>& unknowns, const Progress* progress) {
  const auto before = static_cast<Eigen::Index>(known_.size());
  const auto count = static_cast<Eigen::Index>(unknowns.size());
  std::vector<SparseVector> halves = half_;
  for (Eigen::Index first = 0; first < count; first += kBlock) {
    throw_if_cancelled(progress);
    const auto begin = unknowns.begin() + first;
    std::vector<SparseVector> some =
        solver_.solve_lower_units({begin, begin + std::min<Eigen::Index>(kBlock, count - first)});
    std::move(some.begin(), some.end(), std::back_inserter(halves));
  }
  inverse_.conservativeResize(before + count, before + count);
  for (Eigen::Index j = before; j < before + count; ++j) {
    for (Eigen::Index i = 0; i <= j; ++i) inverse_(i, j) = inverse_(j, i) = halves[i].dot(halves[j]);
  }
  half_ = std::move(halves);
  known_.insert(known_.end(), unknowns.begin(), unknowns.end());
}

// Computes the columns of these unknowns, and keeps their entries at the known ones.
void HeldFactor::add_columns(const std::vector<int>& unknowns, const Progress* progress) {
  const auto count = static_cast<int>(unknowns.size());
  const auto before = static_cast<Eigen::Index>(known_.size());
  std::vector<int> known = known_;
  known.insert(known.end(), unknowns.begin(), unknowns.end());
  Eigen::MatrixXd columns(known.size(), count);
  for (int first = 0; first < count; first += kBlock) {
    throw_if_cancelled(progress);
    const int size = std::min(kBlock, count - first);
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(factored_.size()), size);
    for (int j = 0; j < size; ++j) block(unknowns[first + j], j) = 1.0;
    solver_.solve(block);
    columns.middleCols(first, size) = block(known, Eigen::all);
  }
  inverse_.conservativeResize(columns.rows(), columns.rows());
  inverse_.rightCols(count) = columns;
  inverse_.bottomLeftCorner(count, before) = columns.topRows(before).transpose();
  known_ = std::move(known);
}

Vector HeldFactor::select_left_out(const Vector& x) const {
  Vector result = Vector::Zero(x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (factored_[k] != Side::kBetween) result(k) = x(k);
  }
  return result;
}

int HeldFactor::solve(Vector& x, const Vector& at_contacts) {
  clear(factored_, x);
  const int solves = solver_.has_halves() ? solve_by_halves(x, at_contacts) : solve_whole(x, at_contacts);
  for (const int k : contacts_) x(k) = at_contacts.size() > 0 ? at_contacts(k) : 0.0;
  clear(factored_, x);
  return solves;
}

// Returns the forces that move the contacts from where they would be to where they are held.
Vector HeldFactor::find_forces(Vector reached, const Vector& at_contacts) const {
  if (at_contacts.size() > 0) reached -= at_contacts(contacts_);
  return schur_.solve(reached);
}

int HeldFactor::solve_by_halves(Vector& x, const Vector& at_contacts) {
  if (lower_.size() == 0 || x != right_) {
    right_ = lower_ = x;
    solver_.solve_lower(lower_);
  }
  x = lower_;
  if (!contacts_.empty()) {
    Vector reached(contacts_.size());
    for (Eigen::Index j = 0; j < reached.size(); ++j) reached(j) = half_[column_[j]].dot(x);
    const Vector force = find_forces(std::move(reached), at_contacts);
    for (Eigen::Index j = 0; j < force.size(); ++j) half_[column_[j]].add_to(x, -force(j));
  }
  solver_.solve_upper(x);
  return 1;
}

int HeldFactor::solve_whole(Vector& x, const Vector& at_contacts) {
  Vector right = x;
  solver_.solve(x);
  if (contacts_.empty()) return 1;
  right(contacts_) -= find_forces(x(contacts_), at_contacts);
  x = std::move(right);
  solver_.solve(x);
  return 2;
}

}  // namespace reflines

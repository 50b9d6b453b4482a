#include "optimization/held_factor.h"

#include <algorithm>
#include <utility>

namespace reflines {

void HeldFactor::factorize(const SparseMatrix& H, const Sides& held, const Progress* progress) {
  forget();
  factored_ = held;
  SparseMatrix matrix = H;
  for (int column = 0; column < H.cols(); ++column) {
    const bool column_held = held[column] != Side::kBetween;
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      if (entry.row() != column && (column_held || held[entry.row()] != Side::kBetween)) entry.valueRef() = 0.0;
    }
  }
  solver_.factorize(matrix, progress);
  ++factorizations_;
  is_current_ = true;
}

void HeldFactor::forget() {
  is_current_ = false;
  differences_ = {};
  column_.clear();
  border_.clear();
}

HeldFactor::Differences HeldFactor::find_differences(const Sides& held) const {
  Differences result;
  for (size_t k = 0; k < held.size(); ++k) {
    const bool left_out = factored_[k] != Side::kBetween;
    if (left_out == (held[k] != Side::kBetween)) continue;
    (left_out ? result.released : result.contacts).push_back(static_cast<int>(k));
  }
  return result;
}

bool HeldFactor::leaves_out(const Sides& held) const {
  if (!is_current_) return false;
  const Differences differences = find_differences(held);
  return differences.contacts.empty() && differences.released.empty();
}

bool HeldFactor::hold(const SparseMatrix& H, const Sides& held, const Progress* progress) {
  if (!is_current_) return false;
  Differences differences = find_differences(held);
  // A shifted matrix is not H, to which released unknowns are coupled.
  if (solver_.diagonal_shift() > 0.0 && !differences.released.empty()) return false;
  std::vector<int> wanted;
  for (const std::vector<int>* unknowns : {&differences.contacts, &differences.released}) {
    for (const int k : *unknowns) {
      if (border_.find(k) < 0) wanted.push_back(k);
    }
  }
  if (static_cast<int>(wanted.size()) > kMostNewColumns) return false;
  wanted = border_.sort(std::move(wanted));
  if (!wanted.empty()) border_.add(wanted, make_columns(H, wanted), progress);
  differences_ = std::move(differences);
  factorize_schur_complement(H);
  return true;
}

// Returns the columns of the border: the unit vector of a contact, and a released unknown's column of H without the
// rows that the factor leaves out.
SparseMatrix HeldFactor::make_columns(const SparseMatrix& H, const std::vector<int>& unknowns) const {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> column(factored_.size(), -1);
  bool releases = false;
  for (size_t j = 0; j < unknowns.size(); ++j) {
    const bool left_out = factored_[unknowns[j]] != Side::kBetween;
    releases = releases || left_out;
    if (left_out)
      column[unknowns[j]] = static_cast<int>(j);
    else
      entries.emplace_back(unknowns[j], static_cast<int>(j), 1.0);
  }
  const auto add = [&](int row, int k, double value) {
    if (column[k] >= 0 && factored_[row] == Side::kBetween) entries.emplace_back(row, column[k], value);
  };
  for (int k = 0; releases && k < H.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator entry(H, k); entry; ++entry) {
      add(static_cast<int>(entry.row()), k, entry.value());
      add(k, static_cast<int>(entry.row()), entry.value());
    }
  }
  SparseMatrix columns(H.rows(), static_cast<Eigen::Index>(unknowns.size()));
  columns.setFromTriplets(entries.begin(), entries.end());
  return columns;
}

// Factors the equations of forces and moves: their blocks are those of the products, less H_RR for the moves.
void HeldFactor::factorize_schur_complement(const SparseMatrix& H) {
  const std::vector<int>& released = differences_.released;
  column_.clear();
  for (const int k : differences_.contacts) column_.push_back(border_.find(k));
  for (const int k : released) column_.push_back(border_.find(k));
  if (column_.empty()) return;
  Eigen::MatrixXd system = border_.products()(column_, column_);
  const Eigen::Index first = system.rows() - static_cast<Eigen::Index>(released.size());
  for (Eigen::Index j = first; j < system.rows(); ++j) {
    for (Eigen::Index i = first; i < system.rows(); ++i) {
      const auto [low, high] = std::minmax(released[i - first], released[j - first]);
      system(i, j) -= H.coeff(high, low);
    }
  }
  schur_.compute(system);
}

void HeldFactor::solve(Vector& x) {
  Vector right = Vector::Zero(static_cast<Eigen::Index>(column_.size()));
  right.tail(static_cast<Eigen::Index>(differences_.released.size())) = x(differences_.released);
  clear_held(factored_, x);
  // Forces of contacts, moves of released unknowns, and 0 for those that are neither now.
  const Vector reached = border_.begin(x);
  Vector z = Vector::Zero(reached.size());
  if (!column_.empty()) z(column_) = schur_.solve(Vector(reached(column_)) - right).eval();
  x = border_.finish(z);
  clear_held(factored_, x);
  x(differences_.contacts).setZero();
  x(differences_.released) = z(column_).tail(static_cast<Eigen::Index>(differences_.released.size()));
}

}  // namespace reflines

#include "optimization/held_factor.h"

#include <algorithm>
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
  contacts_.clear();
  known_.clear();
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
  is_current_ = false;
  solver_.factorize(matrix_, progress);
  is_current_ = added.size() == 0;
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
  add_columns(wanted, progress);
  contacts_ = std::move(*contacts);
  schur_.compute(inverse_(column, column));
  return static_cast<int>(wanted.size());
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

int HeldFactor::solve(Vector& x) const {
  clear(factored_, x);
  const Vector right = contacts_.empty() ? Vector() : x;
  solver_.solve(x);
  if (!contacts_.empty()) {
    const Vector force = schur_.solve(x(contacts_));
    x = right;
    x(contacts_) -= force;
    solver_.solve(x);
    for (const int k : contacts_) x(k) = 0.0;
  }
  clear(factored_, x);
  return contacts_.empty() ? 1 : 2;
}

}  // namespace reflines

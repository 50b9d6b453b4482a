#include "optimization/active_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimization/interior_point.h"

namespace reflines {
namespace {

// The distance of a contact from the end of its range in tolerances.
constexpr double kTouching = 30.0;

}  // namespace

Vector ActiveRows::move_inside(const Vector& x) const {
  if (narrow_) return narrow_->pull_inside(narrow_->base, x);
  if (limits_.count_beyond(x) == 0) return x;
  const RowLimits::Narrow narrow = limits_.narrow(limits_.extent(x));
  return narrow.pull_inside(narrow.base, x);
}

void ActiveRows::aim_at(const Vector& minimum) {
  narrow_ = limits_.narrow(limits_.extent(minimum));
  work_.held = narrow_->held;
  quadratic_.emplace(*narrow_, work_.held_factor, work_.solver, counts_, progress_);
}

Vector ActiveRows::room() const {
  const Vector value = narrow_->values(work_.x);
  return quadratic_->ends(contacts_, narrow_->low - value, narrow_->high - value);
}

std::optional<Vector> ActiveRows::lead_on(double, QuasiNewtonMemory* memory) {
  if (!all_press_) return {};
  const Vector change = room();
  Vector d = -left_;
  if (memory != nullptr) memory->before_solve(d);
  d = quadratic_->step_along(contacts_, -d, change, 0.25 * narrow_->tolerance);
  if (memory != nullptr) memory->after_solve(d);
  contacts_keep_ = contacts_.empty() || change.cwiseAbs().maxCoeff() <= narrow_->tolerance;
  const Vector reached = narrow_->values(work_.x + d);
  if ((reached.array() > narrow_->high.array() + 0.5 * narrow_->tolerance).any()) return {};
  if ((reached.array() < narrow_->low.array() - 0.5 * narrow_->tolerance).any()) return {};
  return work_.x + d;
}

Vector ActiveRows::solve_model(double wanted) {
  const Vector value = narrow_->values(work_.x);
  const Vector low = narrow_->low - value, high = narrow_->high - value;
  contacts_keep_ = false;
  Vector d;
  if (!many_) {
    if (!work_.held_factor.is_current()) {
      work_.held_factor.factorize(work_.matrix, narrow_->held, progress_);
      ++counts_.factorizations;
    }
    std::optional<ContactQuadratic::Minimum> minimum =
        quadratic_->minimize(work_.gradient, low, high, 0.5 * narrow_->tolerance, std::move(contacts_));
    many_ = !minimum;
    if (minimum) {
      d = std::move(minimum->d);
      contacts_ = std::move(minimum->contacts);
    }
  }
  if (many_) d = solve_from_inside(low, high, wanted);
  return work_.x + narrow_->longest_step(work_.x, d) * d;
}

Vector ActiveRows::solve_from_inside(const Vector& low, const Vector& high, double wanted) {
  const QuadraticModel model{work_.matrix, work_.gradient};
  const StepLimits limits{&narrow_->rows, low, high, narrow_->held};
  const auto largest = [](const Vector& bound) {
    return bound.array().isFinite().select(bound.array().abs(), 0.0).maxCoeff();
  };
  const double extent = std::max({largest(low), largest(high), narrow_->tolerance});
  const InteriorPoint::Minimum minimum = InteriorPoint(model, limits, extent, work_.held_factor, counts_, progress_)
                                             .minimize(0.5 * narrow_->tolerance, wanted);
  const Vector reached = narrow_->rows.transpose() * minimum.d;
  contacts_.clear();
  std::vector<double> forces;
  for (int i = 0; i < reached.size(); ++i) {
    const double force = minimum.forces(i);
    const double way = force > 0 ? reached(i) - low(i) : high(i) - reached(i);
    if (force == 0 || way > kTouching * narrow_->tolerance) continue;
    contacts_.push_back({i, force > 0 ? Side::kLow : Side::kHigh});
    forces.push_back(std::abs(force));
  }
  forces_ = Eigen::Map<const Vector>(forces.data(), static_cast<Eigen::Index>(forces.size()));
  return minimum.d;
}

// Takes the contacts' forces off the gradient: of those that touch the end of their range and press.
double ActiveRows::measure_gradient() {
  left_ = work_.gradient;
  if (narrow_) {
    const Vector way = room();
    Contacts touching;
    std::vector<int> place;
    for (size_t i = 0; i < contacts_.size(); ++i) {
      if (std::abs(way(static_cast<Eigen::Index>(i))) > kTouching * narrow_->tolerance) continue;
      touching.push_back(contacts_[i]);
      place.push_back(static_cast<int>(i));
    }
    Vector forces(static_cast<Eigen::Index>(touching.size()));
    if (many_)
      forces = forces_(place);
    else if (!touching.empty())
      forces = quadratic_->find_forces(touching, work_.gradient);
    all_press_ = touching.empty() || forces.minCoeff() >= 0;
    left_ = quadratic_->take_off(touching, forces.cwiseMax(0.0), work_.gradient);
    for (int k = 0; k < left_.size(); ++k) {
      if (narrow_->held[k] != Side::kBetween) left_(k) = 0.0;
    }
  }
  return left_.norm();
}

}  // namespace reflines

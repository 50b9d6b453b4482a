#include "optimization/active_set.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimization/bounded_quadratic.h"
#include "optimization/interior_point.h"

namespace reflines {
namespace {

// The distance of a contact from the end of its range in tolerances.
constexpr double kTouching = 30.0;

// The largest part of the projected gradient that a step with the kept factor may leave because the set of held
// unknowns has changed.
constexpr double kWorthwhile = 0.1;

Contacts list_contacts(const Sides& held, const Sides& always) {
  Contacts contacts;
  for (size_t k = 0; k < held.size(); ++k) {
    if (held[k] != Side::kBetween && always[k] == Side::kBetween) contacts.push_back({static_cast<int>(k), held[k]});
  }
  return contacts;
}

}  // namespace

ActiveSet::ActiveSet(const RowLimits& limits, Workspace& workspace, Progress* progress)
    : limits_(limits), work_(workspace), progress_(progress) {
  work_.held_factor.hold_functions(!limits.are_bounds());
  if (!limits.are_bounds()) return;
  narrow_ = limits.narrow(0.0);
  if (work_.held.size() == narrow_->held.size()) contacts_ = list_contacts(work_.held, narrow_->held);
  const auto is_gone = [&](const Contact& own) { return !std::isfinite(narrow_->range.end(own.row, own.side)); };
  std::erase_if(contacts_, is_gone);
}

Vector ActiveSet::move_inside(const Vector& x) const {
  if (narrow_) return narrow_->move_inside(x);
  return limits_.count_beyond(x) == 0 ? x : limits_.narrow(limits_.extent(x)).move_inside(x);
}

void ActiveSet::aim_at(const Vector& minimum) {
  if (!limits_.are_bounds()) narrow_ = limits_.narrow(limits_.extent(minimum));
  contacts_ = limits_.are_bounds() ? list_contacts(narrow_->range.touched_by(minimum), narrow_->held) : Contacts();
  work_.held = narrow_->held;
  work_.many_contacts = false;
}

bool ActiveSet::has_factor(HessianModel model) const {
  return limits_.are_bounds() && work_.has_bounded_factor_of(model, narrow_->range.low.size());
}

Bounds ActiveSet::room() const {
  const Vector value = narrow_->values(work_.x);
  return {narrow_->range.low - value, narrow_->range.high - value};
}

// Returns the ways of the contacts to the ends of their ranges, and notes whether there are any.
Vector ActiveSet::find_ways(const Bounds& room) {
  const Vector ways = ContactQuadratic::ends(contacts_, room);
  contacts_keep_ = contacts_.empty() || ways.cwiseAbs().maxCoeff() <= narrow_->tolerance;
  return ways;
}

std::optional<Vector> ActiveSet::lead_on(double left, QuasiNewtonMemory* memory) {
  const Bounds room = this->room();
  const Vector change = find_ways(room);
  const bool bounds = limits_.are_bounds();
  if (!all_press_ || (bounds && !contacts_keep_)) return {};
  Vector d = -left_;
  if (memory != nullptr) memory->before_solve(d);
  if (bounds)
    work_.held_factor.solve(d);
  else
    d = contact_quadratic().step_along(contacts_, -d, change, 0.25 * narrow_->tolerance);
  if (memory != nullptr) memory->after_solve(d);
  const Vector reached = narrow_->values(d);
  const double beyond = (reached - room.high).cwiseMax(room.low - reached).maxCoeff();
  const bool misses =
      bounds ? measure_missed_gradient({work_.matrix, work_.gradient}, room, work_.held, d) > kWorthwhile * left
             : beyond > 0.5 * narrow_->tolerance;
  if (misses) return {};
  return narrow_->clip(work_.x + d);
}

Vector ActiveSet::solve_model(double wanted) {
  const Bounds room = this->room();
  const bool anew = !work_.many_contacts;
  Vector d;
  if (anew) d = search_contacts(room, wanted);
  if (work_.many_contacts)
    d = limits_.are_bounds() ? eliminate_contacts(room, wanted, anew, d) : solve_from_inside(room, wanted);
  find_ways(room);
  const Vector end = narrow_->end_step(work_.x, d);
  return limits_.are_bounds() ? narrow_->range.nearest(end, contacts_) : end;
}

Vector ActiveSet::search_contacts(const Bounds& room, double wanted) {
  HeldFactor& factor = work_.held_factor;
  if (!factor.leaves_out(narrow_->held)) factor.factorize(work_.matrix, narrow_->held, progress_);
  ContactQuadratic::Minimum minimum =
      contact_quadratic().minimize({work_.matrix, work_.gradient}, room, wanted, std::move(contacts_));
  contacts_ = std::move(minimum.contacts);
  work_.many_contacts = !minimum.complete;
  if (!limits_.are_bounds() || !minimum.complete) return std::move(minimum.d);
  work_.held = narrow_->held;
  for (const Contact& own : contacts_) work_.held[own.row] = own.side;
  factor.hold(work_.matrix, work_.held, progress_);
  return std::move(minimum.d);
}

// Determines the contacts of bounds where there are many, anew from d on, or from those of the last time.
Vector ActiveSet::eliminate_contacts(const Bounds& room, double wanted, bool anew, const Vector& d) {
  const QuadraticModel model{work_.matrix, work_.gradient};
  if (anew) work_.held.clear();
  BoundedMinimum minimum =
      minimize_bounded(model, room, wanted, std::move(work_.held), d, work_.held_factor, progress_);
  work_.held = std::move(minimum.held);
  contacts_ = list_contacts(work_.held, narrow_->held);
  return std::move(minimum.d);
}

Vector ActiveSet::solve_from_inside(const Bounds& room, double wanted) {
  const QuadraticModel model{work_.matrix, work_.gradient};
  const StepLimits limits{&narrow_->rows, room, narrow_->held};
  const double extent = std::max({largest_finite(room.low), largest_finite(room.high), narrow_->tolerance});
  const InteriorMinimum minimum =
      minimize_from_inside(model, limits, extent, 0.5 * narrow_->tolerance, wanted, work_.held_factor, progress_);
  const Vector reached = narrow_->rows.transpose() * minimum.d;
  contacts_.clear();
  std::vector<double> forces;
  for (int i = 0; i < reached.size(); ++i) {
    const double force = minimum.forces(i);
    const double way = force > 0 ? reached(i) - room.low(i) : room.high(i) - reached(i);
    if (force == 0 || way > kTouching * narrow_->tolerance) continue;
    contacts_.push_back({i, force > 0 ? Side::kLow : Side::kHigh});
    forces.push_back(std::abs(force));
  }
  forces_ = Eigen::Map<const Vector>(forces.data(), static_cast<Eigen::Index>(forces.size()));
  return minimum.d;
}

double ActiveSet::measure_gradient() {
  left_ = work_.gradient;
  if (narrow_ && !limits_.are_bounds()) take_off_forces();
  if (narrow_ && !work_.held.empty()) clear_held(work_.held, left_);
  return limits_.are_bounds() ? narrow_->range.projected_norm(work_.x, work_.gradient) : left_.norm();
}

// Takes the contacts' forces off the gradient: of those that touch the end of their range and press.
void ActiveSet::take_off_forces() {
  ContactQuadratic quadratic = contact_quadratic();
  const Bounds room = this->room();
  const Vector way = ContactQuadratic::ends(contacts_, room);
  Contacts touching;
  std::vector<int> place;
  for (size_t i = 0; i < contacts_.size(); ++i) {
    if (std::abs(way(static_cast<Eigen::Index>(i))) > kTouching * narrow_->tolerance) continue;
    touching.push_back(contacts_[i]);
    place.push_back(static_cast<int>(i));
  }
  Vector forces(static_cast<Eigen::Index>(touching.size()));
  if (work_.many_contacts)
    forces = forces_(place);
  else if (!touching.empty())
    forces = quadratic.find_forces(touching, work_.gradient);
  all_press_ = touching.empty() || forces.minCoeff() >= 0;
  left_ = quadratic.take_off(touching, forces.cwiseMax(0.0), work_.gradient);
}

}  // namespace reflines

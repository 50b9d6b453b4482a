#include "reflines/line_handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/sort_unique.h"
#include "geometry/mesh.h"
#include "reflection/reflection_function.h"
#include "reflection/scalar_gradient.h"
#include "reflines/errors.h"
#include "targets/handle_conflicts.h"
#include "targets/line_reader.h"
#include "targets/smooth_change.h"

namespace reflines {
namespace {

// The weight of the values at one place of a handle; the energy of grad c is about the square of its change.
constexpr double kPlaceWeight = 1e4;
// The weight of the values beyond the radii, for an area of radius^2: heights that change under a line must come down
// again somewhere.
constexpr double kStayWeight = 1e4;
constexpr double kFirmest = kStayWeight - 1;  // where the map is 0
// The weight of the values around a pull, for an area of radius^2, and the fraction of the radius where it falls to 0.
// Heights under a held border come to a third to three quarters of c; without it the rest is a corner of the line at
// the handle.
constexpr double kRoundWeight = 500;
constexpr double kRound = 1.0 / 3;
constexpr double kPlaceEdges = 2.5;  // edges that the triangles around a place measure across
constexpr int kMostPlaces = 64;      // of a polyline
constexpr int kFewestVertices = 8;   // within a radius
constexpr const char* kNothingFollows =
    " lies outside its radius, at a pin, on a border that holds or where the fall-off map is 0; move it, or take a "
    "larger radius.";

std::string call(const Handle& handle, int number) {
  return handle.name.empty() ? "Handle " + std::to_string(number + 1) : "Handle " + handle.name;
}

void check(const Handle& handle, int number, Eigen::Index triangles) {
  const bool pin = handle.kind == HandleKind::kPin;
  // Lengths are needed, whose squares have to be finite, too.
  if (!std::isfinite(handle.points.squaredNorm() + handle.centre.squaredNorm() + handle.value + handle.radius)) {
    throw InvalidInput(
        call(handle, number) +
        " has a position, value or radius that is not a finite number, or a position too far away; place it again.");
  }
  if (handle.points.rows() == 0 && !(pin && handle.triangles.size() > 0)) {
    throw InvalidInput(call(handle, number) + " has no point; give one, or several for a curve.");
  }
  if (!pin && !(handle.radius > 0)) {
    throw InvalidInput(call(handle, number) + " has no radius; give the length within which lines may follow it.");
  }
  if (handle.triangles.size() > 0 && (handle.triangles.minCoeff() < 0 || handle.triangles.maxCoeff() >= triangles)) {
    throw InvalidInput(call(handle, number) + " names a triangle that is none of the region's " +
                       std::to_string(triangles) + "; place it again.");
  }
}

// Returns the points of a polyline at steps of about `step`, its corners included where it is short enough.
std::vector<Vector2> resample(const PlanePositions& points, double step) {
  std::vector<Vector2> result = {points.row(0)};
  double length = 0;
  for (int k = 1; k < points.rows(); ++k) length += (points.row(k) - points.row(k - 1)).norm();
  step = std::max(step, length / (kMostPlaces - 1));
  double passed = 0;  // since the last place
  for (int k = 1; k < points.rows(); ++k) {
    const Vector2 from = points.row(k - 1), way = points.row(k).transpose() - from;
    double next = step - passed;
    for (; next <= way.norm() * (1 + 1e-9); next += step) result.emplace_back(from + way * (next / way.norm()));
    passed = way.norm() - (next - step);
  }
  if (points.rows() > 1 && passed > 0.5 * step) result.emplace_back(points.row(points.rows() - 1));
  return result;
}

double measure_distance(const Vector2& point, const PlanePositions& polyline) {
  double nearest = (point - polyline.row(0).transpose()).norm();
  for (int k = 1; k < polyline.rows(); ++k) {
    const Vector2 from = polyline.row(k - 1), way = polyline.row(k).transpose() - from;
    const double square = way.squaredNorm();
    const double t = square > 0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (point - from - t * way).norm());
  }
  return nearest;
}

const PlanePositions& centre_of(const Handle& handle) {
  return handle.centre.rows() > 0 ? handle.centre : handle.points;
}

double mean_edge(const RegionField& field) {
  const auto active = (field.piece.array() >= 0).count();
  return std::sqrt(2.0 * field.area.sum() / static_cast<double>(std::max<Eigen::Index>(active, 1)));
}

// Returns the factor of weights that the energy multiplies values by (see TargetTerms): 1 / (2 pi / diagonal)^2.
double compute_value_scale(const RegionField& field) {
  Vector2 low = Vector2::Constant(INFINITY), high = -low;
  for (int t = 0; t < field.F.rows(); ++t) {
    if (!field.active(t)) continue;
    for (const int v : field.F.row(t)) {
      low = low.cwiseMin(field.xy.row(v).transpose());
      high = high.cwiseMax(field.xy.row(v).transpose());
    }
  }
  return (high - low).squaredNorm() / (4 * std::numbers::pi * std::numbers::pi);
}

// Returns the vertices (#V) all of whose triangles can change and are no features.
Mask find_movable(const RegionField& field, const Mask& changeable) {
  Mask result = Mask::Constant(field.xy.rows(), false);
  for (int t = 0; t < field.F.rows(); ++t) {
    for (const int v : field.F.row(t)) result(v) = result(v) || field.active(t);
  }
  for (int t = 0; t < field.F.rows(); ++t) {
    if (!field.active(t) || (changeable(t) && !field.feature(t))) continue;
    for (const int v : field.F.row(t)) result(v) = false;
  }
  return result;
}

void check_falloff(const Vector& falloff, Eigen::Index vertices) {
  if (falloff.size() == 0) return;
  if (falloff.size() != vertices) {
    throw InvalidInput("The fall-off map has " + std::to_string(falloff.size()) + " values; give one for each of the " +
                       std::to_string(vertices) + " vertices.");
  }
  const auto wrong = falloff.size() - (falloff.array() >= 0 && falloff.array() <= 1).count();  // NaN is neither
  if (wrong == 0) return;
  throw InvalidInput(std::to_string(wrong) + " of the " + std::to_string(vertices) +
                     " values of the fall-off map are not between 0 and 1; 0 holds the lines, 1 lets them follow.");
}

// Returns how firmly lines are held (#V): not at all where the map is 1, and as beyond a radius where it is 0.
Vector compute_firmness(const Vector& falloff, Eigen::Index vertices) {
  if (falloff.size() == 0) return Vector::Zero(vertices);
  return falloff.unaryExpr([](double free) { return std::pow(kStayWeight, 1 - free) - 1; });
}

Location locate(const LineReader& reader, const Vector2& point, const Handle& handle, int number) {
  const Location at = reader.locate(point);
  if (at.triangle >= 0) return at;
  throw InvalidInput(call(handle, number) +
                     " lies off the region's lines (beside it, or on a fillet or fold); move it onto the panel.");
}

double find_largest_radius(const std::vector<Handle>& handles) {
  double radius = 0;
  for (const Handle& handle : handles) {
    if (handle.kind == HandleKind::kPull) radius = std::max(radius, handle.radius);
  }
  return radius;
}

}  // namespace

LineHandles::LineHandles(RegionField field, const Mask& changeable, SpdFactorize factorize, const Vector& falloff)
    : field_(std::make_unique<const RegionField>(std::move(field))),
      movable_(find_movable(*field_, changeable)),
      firmness_(compute_firmness(falloff, field_->xy.rows())),
      value_scale_(compute_value_scale(*field_)),
      factorize_(std::move(factorize)),
      reader_(std::make_unique<const LineReader>(*field_)),
      triangles_of_vertex_(
          std::make_unique<const Incidence>(vertex_triangles(field_->F, static_cast<int>(field_->xy.rows())))) {
  check_falloff(falloff, field_->xy.rows());
}

LineHandles::~LineHandles() = default;

// Returns whether the lines of a whole triangle can be moved. Those beside a held border keep their direction: asked to
// run straight there, the line of a panel of 12 cells was bent twice as far as before.
bool LineHandles::can_lay(int triangle) const {
  const auto& corners = field_->F.row(triangle);
  return movable_(corners(0)) && movable_(corners(1)) && movable_(corners(2));
}

LineHandles::Places LineHandles::find_places(const std::vector<Handle>& handles) const {
  Places result(handles.size());
  for (size_t k = 0; k < handles.size(); ++k) {
    const Handle& handle = handles[k];
    check(handle, static_cast<int>(k), field_->F.rows());
    if (handle.points.rows() == 0) continue;
    const bool pulled_curve = handle.kind == HandleKind::kPull && handle.points.rows() > 1;
    for (const Vector2& point : resample(handle.points, mean_edge(*field_))) {
      const Location at = pulled_curve ? reader_->locate(point) : locate(*reader_, point, handle, static_cast<int>(k));
      if (pulled_curve && (at.triangle < 0 || !can_lay(at.triangle))) continue;
      HandlePlace place{at, point, 0.0, 0.0};
      place.theta = evaluate_theta_near(*field_, place.at, point, 0.0);
      if (handle.kind == HandleKind::kPull) place.change = wrap_angle(handle.value - place.theta);
      result[k].push_back(place);
    }
    if (!result[k].empty()) continue;
    locate(*reader_, handle.points.row(0), handle, static_cast<int>(k));  // throws where that is the reason
    throw InvalidInput(call(handle, static_cast<int>(k)) + kNothingFollows);
  }
  return result;
}

// Returns the vertices (#V) whose lines may change: within a radius, not where the map is 0, and at no pin.
Mask LineHandles::find_part(const std::vector<Handle>& handles, const Places& places) const {
  Mask part = Mask::Constant(field_->xy.rows(), false);
  for (size_t k = 0; k < handles.size(); ++k) {
    if (handles[k].kind != HandleKind::kPull) continue;
    int count = 0;
    for (int v = 0; v < part.size(); ++v) {
      const bool own = movable_(v) && firmness_(v) < kFirmest &&
                       measure_distance(field_->xy.row(v), centre_of(handles[k])) < handles[k].radius;
      part(v) = part(v) || own;
      count += own;
    }
    if (count >= kFewestVertices) continue;
    throw InvalidInput("The radius of " + call(handles[k], static_cast<int>(k)) + " covers " + std::to_string(count) +
                       " vertices that can move; take a larger one, or a handle farther from the border.");
  }
  for (size_t k = 0; k < handles.size(); ++k) {
    if (handles[k].kind != HandleKind::kPin) continue;
    for (const int t : handles[k].triangles) part(field_->F.row(t)) = false;
    for (const HandlePlace& place : places[k]) part(field_->F.row(place.at.triangle)) = false;
  }
  return part;
}

Vector LineHandles::compute_change(const std::vector<Handle>& handles, const Places& places, double radius) {
  const Mask part = find_part(handles, places);
  std::vector<Location> at;
  std::vector<double> values;
  for (size_t k = 0; k < handles.size(); ++k) {
    if (handles[k].kind != HandleKind::kPull) continue;
    for (const HandlePlace& place : places[k]) {
      if (!part(field_->F.row(place.at.triangle)).any()) {
        throw InvalidInput(call(handles[k], static_cast<int>(k)) + kNothingFollows);
      }
      at.push_back(place.at);
      values.push_back(place.change);
    }
  }
  if (!change_ || (change_->part() != part).any()) {
    change_ = std::make_unique<const SmoothChange>(*field_, part, radius, firmness_, factorize_);
  }
  return change_->interpolate(at, Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size())));
}

// Adds the weights of the values (#F) around the handles' places and in pinned triangles.
void LineHandles::weight_places(const std::vector<Handle>& handles, const Places& places, Vector& weight) const {
  for (size_t k = 0; k < handles.size(); ++k) {
    std::vector<int> around(handles[k].triangles.begin(), handles[k].triangles.end());
    for (const HandlePlace& place : places[k]) {
      for (const int v : field_->F.row(place.at.triangle)) {
        for (int e = triangles_of_vertex_->begin(v); e < triangles_of_vertex_->end(v); ++e) {
          around.push_back(triangles_of_vertex_->items[e]);
        }
      }
    }
    sort_unique(around);
    double area = 0;
    for (const int t : around) area += field_->area(t);
    // A pinned area weighs as the places that it has room for.
    const double room = handles[k].triangles.size() > 0 ? area / std::pow(kPlaceEdges * mean_edge(*field_), 2) : 0.0;
    const double count = std::max({1.0, static_cast<double>(places[k].size()), room});
    if (area == 0) continue;  // none of its triangles can be seen
    for (const int t : around) weight(t) = std::max(weight(t), kPlaceWeight * value_scale_ * count / area);
  }
}

double LineHandles::measure_firmness(int triangle) const { return firmness_(field_->F.row(triangle)).mean(); }

double LineHandles::weigh_values(const std::vector<Handle>& handles, const Mask& part, int triangle) const {
  const double stays = part(field_->F.row(triangle)).any() ? measure_firmness(triangle) : kStayWeight;
  const double radius = find_largest_radius(handles);
  double weight = stays * value_scale_ / (radius * radius);
  for (const Handle& handle : handles) {
    if (handle.kind != HandleKind::kPull || field_->feature(triangle)) continue;
    const double fraction = measure_distance(field_->center.row(triangle), handle.points) / (kRound * handle.radius);
    if (fraction >= 1) continue;
    const double most = kRoundWeight * value_scale_ / (handle.radius * handle.radius);
    weight = std::max(weight, most * std::pow(1 - fraction * fraction, 2));
  }
  return weight;
}

std::vector<Target> LineHandles::build(const std::vector<Handle>& handles) {
  const double radius = find_largest_radius(handles);
  const Places places = find_places(handles);
  if (!(radius > 0)) throw InvalidInput("There is no handle that pulls a line; give at least one.");
  const Vector c = compute_change(handles, places, radius);
  Target gradient{field_->gradient, {}, {}, field_->family, true};
  Target value{field_->gradient, Vector::Zero(field_->F.rows()), field_->theta, field_->family, true};
  for (int t = 0; t < field_->F.rows(); ++t) {
    if (!field_->active(t)) continue;
    value.weight(t) = weigh_values(handles, change_->part(), t);
    const int a = field_->F(t, 0), b = field_->F(t, 1), d = field_->F(t, 2);
    if (c(a) != 0 || c(b) != 0 || c(d) != 0) {
      gradient.gradient.row(t) += linear_gradient(field_->xy, field_->F.row(t), c(b) - c(a), c(d) - c(a)).transpose();
      value.theta(t) = wrap_angle(field_->theta(t) + (c(a) + c(b) + c(d)) / 3);
    }
  }
  value.gradient = gradient.gradient;
  Target met{gradient.gradient, Vector::Zero(field_->F.rows()), value.theta, field_->family};
  weight_places(handles, places, met.weight);
  return {std::move(gradient), std::move(value), std::move(met)};
}

std::vector<std::string> LineHandles::find_conflicts(const std::vector<Handle>& handles) const {
  const Places places = find_places(handles);
  std::vector<std::string> result;
  for (size_t j = 0; j < handles.size(); ++j) {
    for (size_t k = j + 1; k < handles.size(); ++k) {
      bool crossing = false;
      for (const HandlePlace& one : places[j]) {
        for (const HandlePlace& other : places[k]) crossing = crossing || force_crossing(*field_, one, other);
      }
      if (!crossing) continue;
      result.push_back(call(handles[j], static_cast<int>(j)) + " and " + call(handles[k], static_cast<int>(k)) +
                       " force lines to cross: move one back, or delete it.");
    }
  }
  return result;
}

int LineHandles::family() const { return field_->family; }

Vector LineHandles::read_theta(const PlanePositions& points) const {
  Vector result(points.rows());
  for (int k = 0; k < points.rows(); ++k) {
    const Vector2 point = points.row(k);
    result(k) = evaluate_theta_near(*field_, locate(*reader_, point, {}, k), point, 0.0);
  }
  return result;
}

Mask LineHandles::can_follow(const PlanePositions& points) const {
  Mask result(points.rows());
  for (int k = 0; k < points.rows(); ++k) {
    const Location at = reader_->locate(points.row(k));
    result(k) = at.triangle >= 0 && can_lay(at.triangle);
  }
  return result;
}

std::vector<HandleResidual> LineHandles::measure(const std::vector<Handle>& handles, const RegionField& now,
                                                 double line_step) const {
  if (now.F.rows() != field_->F.rows() || now.xy.rows() != field_->xy.rows()) {
    throw InvalidInput("The handles belong to another region; make them for this one.");
  }
  if (!(line_step > 0)) throw InvalidInput("The step from line to line must be positive; give 2 pi / their count.");
  const Places places = find_places(handles);
  std::vector<HandleResidual> result(handles.size());
  for (size_t k = 0; k < handles.size(); ++k) {
    for (const HandlePlace& place : places[k]) {
      const double theta = evaluate_theta_near(now, place.at, place.point, place.theta + place.change);
      if (std::abs(theta) < std::abs(result[k].theta)) continue;
      Vector2 gradient = Vector2::Zero(), slope = Vector2::Zero();
      for (int i = 0; i < 3; ++i) {
        gradient += place.at.barycentric(i) * now.vertex_gradient.row(now.F(place.at.triangle, i)).transpose();
        slope += place.at.barycentric(i) * now.vertex_slope.row(now.F(place.at.triangle, i)).transpose();
      }
      const double square = gradient.squaredNorm();
      const double way = square > 0 ? std::sqrt(square + std::pow(slope.dot(gradient), 2)) / square : 0.0;
      result[k] = {theta, std::abs(theta) * way, std::abs(theta) / line_step};
    }
  }
  return result;
}

}  // namespace reflines

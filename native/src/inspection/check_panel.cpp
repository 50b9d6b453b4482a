#include "reflines/check_panel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/parallel_failure.h"
#include "geometry/mesh.h"
#include "geometry/nearest_surface.h"
#include "inspection/check_input.h"
#include "inspection/compare_values.h"
#include "inspection/seams.h"
#include "inspection/side_fit.h"
#include "solver/solve_checks.h"

namespace reflines {
namespace {

constexpr double kMost = 0.95;  // fraction of the vertices that deviation_95 stands for

// Throws where the region is no surface, or a neighbour's vertex is nowhere.
void check_input(const Positions& before, const Positions& after, const Triangles& F, const Mask& region,
                 const CheckOptions& options) {
  check_compared(before, after, F, region);
  check_marked_creases(options.creases.marked, before.rows());
  check_mark(options.gap, "gap");
  check_mark(options.angle, "angle");
  check_mark(options.curvature, "curvature");
  check_mark(options.neighbor_distance, "neighbor_distance");
  if (options.deviation >= 0 || !std::isfinite(options.deviation)) check_mark(options.deviation, "deviation");
}

struct Sides {
  SideFit own, other;
};

// Measures gap and angle, and returns the fits of both sides, whose curvatures are not yet compared.
std::vector<Sides> measure_sides(const Positions& V, const Triangles& F, const Seams& seams, SeamMeasures& measures) {
  const auto count = static_cast<int>(seams.list.size());
  std::vector<Sides> sides(count);
  measures = {Vector::Zero(count), Vector::Zero(count), Vector::Zero(count)};
  const CutSurface cut{F, seams.neighbors};
  run_parallel(count, 64, [&](int k) {
    const Seam& seam = seams.list[k];
    if (seam.other < 0) return;
    const Vector3 a = V.row(seam.first), b = V.row(seam.second), middle = 0.5 * (a + b);
    const Vector3 across = seam.is_joined ? middle
                                          : nearest_in_triangle(middle, V.row(F(seam.other, 0)),
                                                                V.row(F(seam.other, 1)), V.row(F(seam.other, 2)));
    sides[k] = {fit_side(V, cut, seam.own, middle, b - a), fit_side(V, cut, seam.other, across, b - a)};
    const Vector3 &n = sides[k].own.normal, &m = sides[k].other.normal;
    measures.gap(k) = (across - middle).norm();
    measures.angle(k) = std::atan2(n.cross(m).norm(), n.dot(m)) * 180 / std::numbers::pi;
  });
  return sides;
}

double root_mean_square(const std::vector<Sides>& sides) {
  double sum = 0;
  for (const Sides& side : sides) {
    sum += side.own.curvature * side.own.curvature + side.other.curvature * side.other.curvature;
  }
  return std::sqrt(sum / std::max(2.0 * static_cast<double>(sides.size()), 1.0));
}

void compare_curvatures(const std::vector<Sides>& sides, double least, SeamMeasures& measures) {
  for (size_t k = 0; k < sides.size(); ++k) {
    const double own = sides[k].own.curvature, other = sides[k].other.curvature;
    const double scale = std::max({std::abs(own), std::abs(other), least});
    measures.curvature(static_cast<int>(k)) = scale > 0 ? 100 * std::abs(own - other) / scale : 0;
  }
}

// Returns the values that are held against the marks: those after, of a crease their change.
Vector judge_values(const PanelCheck& check, const Vector& before, const Vector& after) {
  Vector result = after;
  for (int k = 0; k < result.size(); ++k) {
    if (check.kind[k] == SeamKind::kCrease) result(k) = std::abs(after(k) - before(k));
    if (check.kind[k] == SeamKind::kOpen) result(k) = 0;
  }
  return result;
}

void measure_deviation(const Positions& before, const Positions& after, const Triangles& F, const Mask& region,
                       PanelCheck& check) {
  Mask used = Mask::Constant(before.rows(), false);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3 && region(t); ++i) used(F(t, i)) = true;
  }
  const NearestSurface surface(before, F);
  check.deviation = Vector::Zero(before.rows());
  run_parallel(static_cast<int>(before.rows()), 256, [&](int v) {
    const double moved = (after.row(v) - before.row(v)).norm();
    if (used(v) && moved > 0) check.deviation(v) = surface.find(after.row(v), moved * (1 + 1e-12)).distance;
  });
  std::vector<double> sorted;
  for (const int v : list_marked(used)) sorted.push_back(check.deviation(v));
  std::sort(sorted.begin(), sorted.end());
  check.largest_deviation = sorted.back();
  check.deviation_95 = sorted[static_cast<size_t>(std::ceil(kMost * static_cast<double>(sorted.size()))) - 1];
}

// Returns how a value of a seam changed.
Change compare_seam(SeamKind kind, double before, double after, double mark) {
  if (kind == SeamKind::kBorder) return compare_values(before, after, mark);
  const bool changed = kind == SeamKind::kCrease && std::abs(after - before) > mark;
  return changed ? Change::kWorse : Change::kUnchanged;
}

// Returns how a line changed: for the worse where its largest value did, or more seams did than became better.
Change weigh(const CheckRow& row, Change largest) {
  if (largest == Change::kWorse || row.worse > row.better) return Change::kWorse;
  return row.better > row.worse ? Change::kBetter : largest;
}

// Adds the line of a measure along the seams of one kind, where there are any.
void add_seam_row(const std::string& name, const std::string& unit, SeamKind kind, const Vector& before,
                  const Vector& after, double mark, const Positions& V, PanelCheck& check) {
  CheckRow row{.name = name, .unit = unit, .mark = mark};
  const Vector judged = judge_values(check, before, after);
  int worst = -1, grown = -1;
  const auto growth = [&](int k) { return std::abs(after(k) - before(k)); };
  for (int k = 0; k < judged.size(); ++k) {
    if (check.kind[k] != kind) continue;
    row.before = std::max(row.before, before(k));
    row.after = std::max(row.after, after(k));
    row.passes = row.passes && judged(k) <= mark;
    if (worst < 0 || judged(k) > judged(worst)) worst = k;
    const Change change = compare_seam(kind, before(k), after(k), mark);
    row.better += change == Change::kBetter;
    row.worse += change == Change::kWorse;
    if (change == Change::kWorse && (grown < 0 || growth(k) > growth(grown))) grown = k;
  }
  if (worst < 0) return;
  row.change = weigh(row, compare_seam(kind, row.before, row.after, mark));
  const int shown = row.change == Change::kWorse && grown >= 0 ? grown : worst;
  row.place = 0.5 * (V.row(check.edges(shown, 0)) + V.row(check.edges(shown, 1)));
  check.rows.push_back(row);
}

void fill_rows(const Positions& after, const CheckOptions& marks, PanelCheck& check) {
  const SeamMeasures &first = check.before, &last = check.after;
  add_seam_row("border gap", "length", SeamKind::kBorder, first.gap, last.gap, marks.gap, after, check);
  for (const auto& [kind, name] : {std::pair(SeamKind::kBorder, "border"), std::pair(SeamKind::kCrease, "crease")}) {
    add_seam_row(std::string(name) + " angle", "degrees", kind, first.angle, last.angle, marks.angle, after, check);
    add_seam_row(std::string(name) + " curvature", "percent", kind, first.curvature, last.curvature, marks.curvature,
                 after, check);
  }
  int furthest = 0;
  check.deviation.maxCoeff(&furthest);
  const bool within = marks.deviation < 0 || check.largest_deviation <= marks.deviation;
  check.rows.push_back({"deviation", "length", 0, check.largest_deviation, marks.deviation, within, after.row(furthest),
                        within ? Change::kUnchanged : Change::kWorse});
  check.rows.push_back({"deviation of 95 %", "length", 0, check.deviation_95, -1, true, after.row(furthest)});
}

void judge(const CheckOptions& marks, PanelCheck& check) {
  const SeamMeasures &first = check.before, &last = check.after;
  check.passes = judge_values(check, first.gap, last.gap).array() <= marks.gap &&
                 judge_values(check, first.angle, last.angle).array() <= marks.angle &&
                 judge_values(check, first.curvature, last.curvature).array() <= marks.curvature;
  for (int k = 0; k < static_cast<int>(check.kind.size()); ++k) {
    const SeamKind kind = check.kind[k];
    check.change.push_back(sum_up({compare_seam(kind, first.gap(k), last.gap(k), marks.gap),
                                   compare_seam(kind, first.angle(k), last.angle(k), marks.angle),
                                   compare_seam(kind, first.curvature(k), last.curvature(k), marks.curvature)}));
  }
}

}  // namespace

bool PanelCheck::all_pass() const {
  return std::all_of(rows.begin(), rows.end(), [](const CheckRow& row) { return row.passes; });
}

PanelCheck check_panel(const Positions& before, const Positions& after, const Triangles& F, const Mask& region,
                       const CheckOptions& options) {
  check_input(before, after, F, region, options);
  const Seams seams = find_seams(before, F, region, options);
  PanelCheck check;
  check.edges.resize(static_cast<int>(seams.list.size()), 2);
  for (size_t k = 0; k < seams.list.size(); ++k) {
    check.edges.row(static_cast<int>(k)) << seams.list[k].first, seams.list[k].second;
    check.kind.push_back(seams.list[k].kind);
  }
  const std::vector<Sides> first = measure_sides(before, F, seams, check.before);
  const std::vector<Sides> last = measure_sides(after, F, seams, check.after);
  const double least = root_mean_square(first);
  compare_curvatures(first, least, check.before);
  compare_curvatures(last, least, check.after);
  measure_deviation(before, after, F, region, check);
  judge(options, check);
  fill_rows(after, options, check);
  return check;
}

}  // namespace reflines

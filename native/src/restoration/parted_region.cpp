#include "restoration/parted_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geometry/bounding_box.h"
#include "geometry/mesh.h"
#include "reflines/errors.h"
#include "restoration/joint_press.h"
#include "restoration/merged_report.h"
#include "restoration/press_rules.h"

namespace reflines {
namespace {

constexpr double kMargin = 1.05;  // of what a press takes in

using Lists = std::vector<std::vector<int>>;

double mean_border_edge(const Positions& V, const Triangles& F) {
  double sum = 0;
  const Triangles edges = find_border_edges(F, edge_neighbors(F));
  for (const auto& edge : edges.rowwise()) sum += (V.row(edge(0)) - V.row(edge(1))).norm();
  return sum / std::max(static_cast<double>(edges.rows()), 1.0);
}

bool continues_curvature(const std::vector<Border>& border) {
  return std::any_of(border.begin(), border.end(),
                     [](Border own) { return own == Border::kCurvature || own == Border::kFlow; });
}

struct Whole {
  const Positions& V;
  const Triangles& F;
  const SmoothPanelOptions& options;
  Lists parts;
  std::vector<Eigen::AlignedBox3d> boxes;
  double widest = 0;  // gap between parts that are smoothed as one
  double gap = 0;     // within which others are looked for: a dent may lift one rim from the other's fit
};

// Returns the triangles of the other parts that are near one of them.
Triangles list_others(const Whole& whole, size_t own) {
  std::vector<int> others;
  for (size_t k = 0; k < whole.parts.size(); ++k) {
    const bool near = whole.boxes[own].exteriorDistance(whole.boxes[k]) <= whole.gap;
    if (k != own && near) others.insert(others.end(), whole.parts[k].begin(), whole.parts[k].end());
  }
  return whole.F(others, Eigen::all);
}

bool has_inner_vertex(const Whole& whole, const std::vector<int>& triangles) {
  const UsedVertices used = find_used_vertices(whole.F(triangles, Eigen::all), static_cast<int>(whole.V.rows()));
  return !find_border_vertices(used.F, static_cast<int>(used.index.size())).all();
}

// Marks the vertices (#V) of a part at which its border goes on into another one and may move.
Mask find_facing(const Whole& whole, size_t own) {
  const auto count = static_cast<int>(whole.V.rows());
  Mask facing = Mask::Constant(count, false);
  const Triangles others = list_others(whole, own);
  if (others.rows() == 0) return facing;
  const UsedVertices used = find_used_vertices(whole.F(whole.parts[own], Eigen::all), count);
  Surroundings around;
  if (whole.options.around.exist()) around = renumber_surroundings(whole.options.around, used, count);
  const GapContinuation found =
      continue_over_gap(whole.V(used.index, Eigen::all), used.F, around, whole.V, others, {whole.gap, whole.gap});
  const std::vector<Border>& border = whole.options.border;
  for (size_t k = 0; k < used.index.size(); ++k) {
    const int v = used.index[k];
    const bool held =
        (!border.empty() && border[v] == Border::kFixed) || (whole.options.held.size() > 0 && whole.options.held(v));
    const auto own_number = static_cast<Eigen::Index>(k);
    facing(v) = found.followed(own_number) && found.width(own_number) <= whole.widest && !held;
  }
  return facing;
}

// Builds the panel of some triangles of the region, which follows other parts where it faces them (#V).
JointPanel build_panel(const Whole& whole, const std::vector<int>& triangles, const Mask& facing, const Vector3& view,
                       const Vector3& lines) {
  JointPanel panel{whole.V, whole.F(triangles, Eigen::all), view, lines, whole.options, {}, {}, {}};
  SmoothPanelOptions& options = panel.options;
  options.border.resize(whole.V.rows(), Border::kClamped);
  const UsedVertices used = find_used_vertices(panel.F, static_cast<int>(whole.V.rows()));
  Mask own = Mask::Constant(whole.V.rows(), false);
  for (const int v : used.index) {
    own(v) = true;
    if (facing(v)) options.border[v] = Border::kFollow;
  }
  for (int& image : options.partner) {
    if (image >= 0 && !own(image)) image = -1;  // moved alike at the end
  }
  if (options.face_of_triangle.size() > 0) options.face_of_triangle = whole.options.face_of_triangle(triangles).eval();
  panel.around_is_followed = true;
  const double diagonal = bounding_box_diagonal(whole.V(used.index, Eigen::all));
  const double length = options.length > 0 ? options.length : options.flaw_size * kAutomaticLength * diagonal;
  panel.gap = {whole.gap, kMargin * kFairMargin * length};
  return panel;
}

double measure_area(const Positions& V, const Triangles& F, const std::vector<int>& triangles) {
  double area = 0;
  for (const int t : triangles) {
    const Vector3 a = V.row(F(t, 0)), b = V.row(F(t, 1)), c = V.row(F(t, 2));
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

class PartedPress : public Press {
 public:
  PartedPress(const Whole& whole, Lists lists, std::vector<JointPanel> panels, const Vector3& view,
              const PressAmount& amount, PreparePress prepare_whole)
      : V_(whole.V),
        F_(whole.F),
        axis_(view.normalized()),
        partner_(whole.options.partner),
        lists_(std::move(lists)),
        prepare_whole_(std::move(prepare_whole)),
        press_(std::move(panels), std::vector<PressAmount>(lists_.size(), amount)) {}

  SmoothPanelResult run(const PressAmount& amount) override {
    try {
      if (!whole_) return run_parts(amount);
    } catch (const InvalidInput&) {  // what one part cannot is no reason to refuse the others
      whole_ = prepare_whole_();
    } catch (const SolverFailure&) {
      whole_ = prepare_whole_();
    }
    return whole_->run(amount);
  }

 private:
  SmoothPanelResult run_parts(const PressAmount& amount) {
    const std::vector<SmoothPanelResult> results = press_.run(std::vector<PressAmount>(lists_.size(), amount));
    std::vector<PressedPart> pressed;
    Positions positions = V_;
    for (size_t k = 0; k < lists_.size(); ++k) {
      pressed.push_back({lists_[k], measure_area(V_, F_, lists_[k]), results[k].report});
      for (const int t : lists_[k]) {
        for (const int v : F_.row(t)) positions.row(v) = results[k].positions.row(v);
      }
    }
    even_doubled(positions);
    even_partners(positions);
    return {std::move(positions), merge_reports(pressed, F_.rows())};
  }

  // Gives vertices of the region that lie on each other the mean of their moves.
  void even_doubled(Positions& positions) const {
    std::map<std::array<double, 3>, std::vector<int>> at;
    for (const int v : find_used_vertices(F_, static_cast<int>(V_.rows())).index)
      at[{V_(v, 0), V_(v, 1), V_(v, 2)}].push_back(v);
    for (const auto& [place, vertices] : at) {
      if (vertices.size() < 2) continue;
      const Vector3 mean = positions(vertices, Eigen::all).colwise().mean().transpose();
      for (const int v : vertices) positions.row(v) = mean;
    }
  }

  void even_partners(Positions& positions) const {
    for (int v = 0; v < partner_.size(); ++v) {
      const int other = partner_(v);
      if (other <= v) continue;
      const double one = (positions.row(v) - V_.row(v)).dot(axis_);
      const double two = (positions.row(other) - V_.row(other)).dot(axis_);
      if (one == two) continue;
      positions.row(v) = V_.row(v) + 0.5 * (one + two) * axis_.transpose();
      positions.row(other) = V_.row(other) + 0.5 * (one + two) * axis_.transpose();
    }
  }

  Positions V_;
  Triangles F_;
  Vector3 axis_;
  IndexVector partner_;
  Lists lists_;  // the triangles of each panel
  PreparePress prepare_whole_;
  JointPress press_;
  std::unique_ptr<Press> whole_;  // null while the parts can be solved
};

}  // namespace

std::unique_ptr<Press> prepare_parted_region(const Positions& V, const Triangles& F, const Vector3& view,
                                             const Vector3& lines, const SmoothPanelOptions& options,
                                             const PressAmount& amount, const PreparePress& prepare_whole) {
  if (options.fair_border.any() || continues_curvature(options.border)) return nullptr;
  Whole whole{V, F, options, find_components(edge_neighbors(F)), {}};
  if (whole.parts.size() < 2 || static_cast<int>(whole.parts.size()) > kRules.joint.most_parts) return nullptr;
  whole.widest = options.parts_gap > 0 ? options.parts_gap : kRules.joint.touching * mean_border_edge(V, F);
  for (const std::vector<int>& part : whole.parts) {
    Eigen::AlignedBox3d& box = whole.boxes.emplace_back();
    for (const int t : part) {
      for (const int v : F.row(t)) box.extend(V.row(v).transpose());
    }
  }
  Eigen::AlignedBox3d box;  // vertices in no face may be anywhere
  for (const Eigen::AlignedBox3d& own : whole.boxes) box.extend(own);
  whole.gap = std::max(whole.widest, kAutomaticGap * box.diagonal().norm());
  Lists lists;
  std::vector<int> alone;  // triangles of the parts that face no other: one panel
  std::vector<JointPanel> panels;
  for (size_t k = 0; k < whole.parts.size(); ++k) {
    const Mask facing =
        has_inner_vertex(whole, whole.parts[k]) ? find_facing(whole, k) : Mask(Mask::Constant(V.rows(), false));
    if (!facing.any()) {
      alone.insert(alone.end(), whole.parts[k].begin(), whole.parts[k].end());
      continue;
    }
    panels.push_back(build_panel(whole, whole.parts[k], facing, view, lines));
    lists.push_back(whole.parts[k]);
  }
  if (panels.empty()) return nullptr;
  if (has_inner_vertex(whole, alone)) {
    panels.push_back(build_panel(whole, alone, Mask::Constant(V.rows(), false), view, lines));
    lists.push_back(alone);
  }
  return std::make_unique<PartedPress>(whole, std::move(lists), std::move(panels), view, amount, prepare_whole);
}

}  // namespace reflines

#include "reflines/smooth_panel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "geometry/crease.h"
#include "geometry/height_field.h"
#include "reflines/errors.h"
#include "restoration/bump_removal.h"
#include "restoration/crease_preserving_smoother.h"
#include "restoration/flaw_weight.h"
#include "restoration/mirror_evidence.h"

namespace reflines {
namespace {

// Of the diagonal. Of 1/8, 1/10, 1/12, 1/14 and 1/16 the shorter ones harm clean panels less (0.26 to 0.17 degrees in
// the median) and ripples and noise go as well; dents are wider, and are looked for by themselves.
constexpr double kAutomaticLength = 1.0 / 14.0;

// Of the length: dents of 6 per mille of the length are taken out whole, and no design is moved by more than an artist
// may overlook.
constexpr double kAutomaticLimit = 1.0 / 20.0;

// The lines hardly see a shape that is as long as the panel: this keeps it where it is (see Energy). Of 0, 1e5, 1e6,
// 1e7, with the lines of the clean panel as target: 0, 0.4, 4 and 30 % left of dents, and less harm the higher.
constexpr double kProximity = 1e6;

constexpr SmootherOptions kLineSmoother = {.crease_jump = 2.0, .rounds = 6};
constexpr int kBumpRounds = 3;  // where dents overlap, the second is seen when the first is gone

constexpr double kTurned = std::numbers::pi / 4;
constexpr int kRetries = 3;
constexpr double kWorse = 1.01;

double diagonal_of(const Positions& V) { return (V.colwise().maxCoeff() - V.colwise().minCoeff()).norm(); }

std::vector<Vector3> make_families(const Vector3& view, const Vector3& lines, Lights lights) {
  if (lights == Lights::kSingle) return {lines};
  return {lines, view.cross(lines)};
}

TriangleFields read_fields(const ShapeOptimizer& optimizer) {
  TriangleFields result(optimizer.triangle_count(), 2 * optimizer.family_count());
  for (int k = 0; k < optimizer.family_count(); ++k) result.middleCols(2 * k, 2) = optimizer.field(k);
  return result;
}

std::vector<Target> make_targets(const TriangleFields& fields) {
  std::vector<Target> result(fields.cols() / 2);
  for (size_t k = 0; k < result.size(); ++k) {
    result[k].gradient = fields.middleCols(2 * static_cast<Eigen::Index>(k), 2);
    result[k].family = static_cast<int>(k);
  }
  return result;
}

std::string degrees(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// One panel on its way through the steps of smooth_panel.
class Restoration {
 public:
  Restoration(const Positions& V, const Triangles& F, const Vector3& view, const Vector3& lines,
              const SmoothPanelOptions& options)
      : start_(V),
        F_(F),
        view_(view),
        families_(make_families(view, lines, options.lights)),
        frame_(view, lines),
        options_(options) {
    shape_.border = options.border;
    shape_.held = options.held.size() > 0 ? options.held : Mask::Constant(V.rows(), false);
    shape_.creases.rule = CreaseRule::kNone;  // noise makes creases; smoother and weights keep what bends
    shape_.proximity = kProximity;
    shape_.progress = options.progress;
  }

  SmoothPanelResult run() {
    ShapeOptimizer optimizer(start_, F_, view_, families_, shape_);  // checks the mesh
    report_.region = optimizer.region();
    report_.length = options_.length > 0 ? options_.length : kAutomaticLength * diagonal_of(start_);
    report_.limit = options_.limit > 0 ? options_.limit : kAutomaticLimit * report_.length;
    smoother_.emplace(optimizer.xy(), F_, optimizer.area(), report_.length, kLineSmoother);
    measure(optimizer, report_.unevenness_before);
    report_.stray = stray_;
    Positions V = restore(optimizer);
    for (int retry = 0; retry < kRetries && hold_turned(V); ++retry) V = restore(optimizer);
    measure_after(V);
    if (report_.limited > 0 && find_worse_light() >= 0) {
      V = scale_to_limit();
      measure_after(V);
    }
    return judge(V);
  }

 private:
  Progress* progress() const { return options_.progress.get(); }

  Positions lift(const Positions& V, const Vector& move) const {
    Positions result = V;
    for (Eigen::Index v = 0; v < V.rows(); ++v) {
      if (move(v) != 0 && !shape_.held(v)) result.row(v) += move(v) * frame_.z().transpose();
    }
    return result;
  }

  HeightField make_field(const Positions& V) const {
    Boundary boundary{shape_.border, shape_.held, shape_.creases};
    if (boundary.border.empty()) boundary.border.assign(V.rows(), Border::kClamped);
    return make_height_field(V, F_, frame_, boundary);
  }

  Positions restore(const ShapeOptimizer& optimizer) {
    report_.bumps = 0;
    Positions V = options_.symmetric ? use_symmetry(optimizer) : start_;
    for (int round = 0; round < kBumpRounds; ++round) {
      const BumpRemoval removal = remove_bumps(make_field(V), report_.length, progress());
      if (removal.count == 0) break;
      V = lift(V, removal.move);
      report_.bumps += removal.count;
    }
    return within_limit(average_partners(smooth_lines(V)), options_.strength);
  }

  Positions use_symmetry(const ShapeOptimizer& optimizer) {
    PlanePositions axes(3, 2);
    for (int k = 0; k < 3; ++k) axes.row(k) = frame_.to_frame(Vector3::Unit(k)).head<2>();
    const MirrorEvidence evidence = find_mirror_evidence(frame_.project(start_), frame_.heights(start_), F_,
                                                         diagonal_of(start_), report_.length, axes);
    report_.mirrored = static_cast<int>(evidence.partner.size());
    partner_ = evidence.partner;
    free_ = optimizer.free();
    return report_.mirrored > 0 ? lift(start_, free_.select(evidence.correction.array(), 0.0).matrix()) : start_;
  }

  // Stencils and the cut of quads are not symmetric, so that the solve leaves partners 3e-5 of the diagonal apart.
  Positions average_partners(const Positions& V) const {
    if (partner_.size() == 0) return V;
    const Vector z = frame_.heights(V);
    Vector move = Vector::Zero(z.size());
    for (Eigen::Index v = 0; v < z.size(); ++v) {
      if (free_(v) && free_(partner_(v))) move(v) = 0.5 * (z(partner_(v)) - z(v));
    }
    return lift(V, move);
  }

  Positions smooth_lines(const Positions& V) {
    ShapeOptimizer optimizer(V, F_, view_, families_, shape_);
    const TriangleFields fields = read_fields(optimizer);
    const TriangleFields change = smoother_->smooth(fields, progress()) - fields;
    const Vector weight = flaw_weight(change, optimizer.centers(), optimizer.area(), report_.length);
    const std::vector<Target> targets = make_targets(fields + weight.asDiagonal() * change);
    solve(optimizer, targets, MoveLimit::none());
    unlimited_ = optimizer.positions();
    report_.limited = static_cast<int>((move_of(unlimited_).array().abs() > report_.limit).count());
    return report_.limited == 0 ? unlimited_ : smooth_within_limit(V, targets);
  }

  // Cutting the move at the limit would leave an edge round every plateau, in lines that were even: it is solved for.
  Positions smooth_within_limit(const Positions& V, const std::vector<Target>& targets) {
    const Positions nearest = within_limit(V, 1.0);
    const Vector move = move_of(nearest);
    ShapeOptimizer optimizer(nearest, F_, view_, families_, shape_);
    solve(optimizer, targets,
          {(-report_.limit - move.array()).cwiseMin(0).matrix(), (report_.limit - move.array()).cwiseMax(0).matrix()});
    return optimizer.positions();
  }

  // The rim of a flaw far deeper than the limit can make the lines less even than the flaw did. The same share of the
  // whole move everywhere cannot.
  Positions scale_to_limit() const {
    const Positions V = average_partners(unlimited_);
    const double share = report_.limit / move_of(V).cwiseAbs().maxCoeff();
    return add_move(options_.strength * std::min(share, 1.0) * move_of(V), V);
  }

  void solve(ShapeOptimizer& optimizer, const std::vector<Target>& targets, const MoveLimit& limit) {
    report_.solve = optimizer.solve(targets, {}, progress(), limit);
    if (report_.solve.termination == Termination::kCancelled) throw Cancelled();
  }

  Vector move_of(const Positions& V) const { return frame_.heights(V) - frame_.heights(start_); }

  // A share of the move from the start, which is cut at the limit first.
  Positions within_limit(const Positions& V, double share) const {
    return add_move(share * move_of(V).cwiseMax(-report_.limit).cwiseMin(report_.limit), V);
  }

  // The start with a move along the view, of the vertices that V has moved.
  Positions add_move(const Vector& move, const Positions& V) const {
    Positions result = start_;
    for (Eigen::Index v = 0; v < V.rows(); ++v) {
      if (V.row(v) != start_.row(v)) result.row(v) += move(v) * frame_.z().transpose();
    }
    return result;
  }

  // Holds the vertices of triangles that turned too far; true where there are new ones.
  bool hold_turned(const Positions& V) {
    const Positions before = triangle_normals(start_, F_), after = triangle_normals(V, F_);
    int turned = 0;
    for (Eigen::Index t = 0; t < F_.rows(); ++t) {
      if (before.row(t).dot(after.row(t)) >= std::cos(kTurned) * before.row(t).norm()) continue;
      ++turned;
      for (int i = 0; i < 3; ++i) shape_.held(F_(t, i)) = true;
    }
    report_.held_faces += turned;
    return turned > 0;
  }

  void measure(const ShapeOptimizer& optimizer, std::vector<double>& unevenness) {
    const TriangleFields fields = read_fields(optimizer);
    if (creases_.size() == 0) smoother_->smooth(fields, progress(), &creases_);
    const TriangleFields off = fields - smoother_->smooth_with(creases_, fields);
    stray_ = off.leftCols(2).rowwise().norm();
    const Vector area = optimizer.area();
    for (int k = 0; k < optimizer.family_count(); ++k) {
      const double squared = area.dot(off.middleCols(2 * k, 2).rowwise().squaredNorm()) / area.sum();
      unevenness.push_back(std::sqrt(squared) * report_.length * 180.0 / std::numbers::pi);
    }
  }

  void measure_after(const Positions& V) {
    report_.unevenness_after.clear();
    measure(ShapeOptimizer(V, F_, view_, families_, shape_), report_.unevenness_after);
  }

  // The light in which the lines became less even, -1 where there is none.
  int find_worse_light() const {
    for (size_t k = 0; k < families_.size(); ++k) {
      if (report_.unevenness_after[k] > kWorse * report_.unevenness_before[k]) return static_cast<int>(k);
    }
    return -1;
  }

  SmoothPanelResult judge(const Positions& V) {
    const bool turned = hold_turned(V);
    const int k = find_worse_light();
    if (turned || k >= 0) {
      report_.applied = false;
      report_.messages.push_back(
          turned ? "Nothing was changed: faces would have turned by more than 45 degrees. Select less."
                 : "Nothing was changed: the lines would have become less even in one light (" +
                       degrees(report_.unevenness_before[k]) + " to " + degrees(report_.unevenness_after[k]) +
                       " degrees). Select less, or give a Length.");
      return {start_, report_};
    }
    report_.stray = stray_;
    report_.largest_move = move_of(V).cwiseAbs().maxCoeff();
    tell();
    return {V, report_};
  }

  void tell() {
    const auto counted = [](int count, const std::string& one, const std::string& many) {
      return std::to_string(count) + " " + (count == 1 ? one : many);
    };
    if (report_.limited > 0) {
      report_.messages.push_back("The limit of the move holds back " + counted(report_.limited, "vertex", "vertices") +
                                 "; what is deeper is left.");
    }
    if (report_.held_faces > 0) {
      report_.messages.push_back(counted(report_.held_faces, "triangle was", "triangles were") +
                                 " left alone that would have turned by more than 45 degrees.");
    }
  }

  Positions start_;
  Triangles F_;
  Vector3 view_;
  std::vector<Vector3> families_;
  ImagePlane frame_;
  SmoothPanelOptions options_;
  ShapeOptions shape_;
  std::optional<CreasePreservingSmoother> smoother_;
  Vector creases_;       // weights of the edges, of the start
  IndexVector partner_;  // see MirrorEvidence; empty: no symmetry
  Mask free_;
  Positions unlimited_;  // the last solution without the limit
  Vector stray_;         // of the shape measured last, see SmoothPanelReport
  SmoothPanelReport report_;
};

void check(const SmoothPanelOptions& options, Eigen::Index vertex_count) {
  const auto refuse = [](const char* what) { throw InvalidInput(what); };
  if (!(options.length >= 0) || !std::isfinite(options.length))
    refuse("The length must be a positive length, or 0 for automatic.");
  if (!(options.limit >= 0)) refuse("The limit must be a positive length, or 0 for automatic.");
  if (!(options.strength >= 0 && options.strength <= 1)) refuse("The strength must lie between 0 and 1.");
  if (options.held.size() > 0 && options.held.size() != vertex_count) {
    throw InvalidInput("The held mask has " + std::to_string(options.held.size()) + " entries for " +
                       std::to_string(vertex_count) + " vertices; give one for each.");
  }
}

}  // namespace

SmoothPanelResult smooth_panel(const Positions& V, const Triangles& F, const Vector3& view_direction,
                               const Vector3& line_direction, const SmoothPanelOptions& options) {
  check(options, V.rows());
  return Restoration(V, F, view_direction, line_direction, options).run();
}

}  // namespace reflines

#include "restoration/held_border.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "reflines/errors.h"
#include "restoration/controlled_surface.h"
#include "restoration/press_rules.h"
#include "restoration/press_setup.h"
#include "restoration/restoration.h"
#include "solver/mirror_coupling.h"
#include "solver/optimizer_internals.h"

namespace reflines {
namespace {

void clamp_all(std::vector<Border>& borders) {
  for (Border& border : borders) border = std::min(border, Border::kClamped);
}

ShapeOptions clamp_instead(const ShapeOptions& shape) {
  ShapeOptions result = shape;
  clamp_all(result.border);
  result.around = {};
  return result;
}

// Compares two numbers in degrees.
bool is_less_even(double one, double other) {
  return one > std::max(kRules.verdict.worse * other, other + kRules.border.less_even);
}

struct Deviations {
  double one, other;  // degrees
};

// Finds the first light in which a result is less even than another one, and by which numbers.
std::optional<Deviations> find_less_even(const SmoothPanelReport& one, const SmoothPanelReport& other) {
  for (size_t k = 0; k < one.score_after.size(); ++k) {
    for (const Deviations deviations : {Deviations{one.score_after[k].shift, other.score_after[k].shift},
                                        Deviations{one.unevenness_after[k], other.unevenness_after[k]}}) {
      if (is_less_even(deviations.one, deviations.other)) return deviations;
    }
  }
  return std::nullopt;
}

// Returns whether a press changes anything: a cage's gain, too, may leave nothing of a move.
bool moves_anything(const SmoothPanelReport& report) { return report.applied && report.largest_control_move > 0; }

// Tells why the clamped result was chosen.
Note explain_clamped(bool continued_moves, const std::optional<Deviations>& deviations) {
  if (!continued_moves || !deviations) return {NoteKind::kContinuingChangesNothing};
  return {.kind = NoteKind::kContinuingWorsens, .before = deviations->other, .after = deviations->one};
}

// Finds the move with the curvature continued. Empty where the solver breaks down: what lies beside the region is no
// reason to refuse it.
std::optional<Vector> find_continued_move(Restoration& press, const PressAmount& amount) {
  try {
    return press.find_move(amount);
  } catch (const SolverFailure&) {
    return std::nullopt;
  }
}

// Returns the clamped move and as much of what continuing the curvature adds as is no larger than
// kRules.border.most_added times it. What lies beside the region tells how its flaws go on, and is no reason to bend a
// design: beside a fillet the skirt of a panel went by 7 and 9 times what flaws there moved.
Vector bound_addition(const Vector& clamped, const Vector& continued) {
  const double most = kRules.border.most_added * clamped.cwiseAbs().maxCoeff();
  const double added = (continued - clamped).cwiseAbs().maxCoeff();
  if (added <= most) return continued;
  return clamped + most / added * (continued - clamped);
}

// Chooses between the presses with the curvature continued and clamped.
SmoothPanelResult press_both(Restoration& press, Restoration& clamped_press, const PressAmount& amount) {
  const Vector clamped_move = clamped_press.find_move(amount);
  SmoothPanelResult clamped = clamped_press.judge(clamped_move);
  const std::optional<Vector> continued_move = find_continued_move(press, amount);
  if (!continued_move) {
    clamped.report.notes.push_back({NoteKind::kContinuingFails});
    return clamped;
  }
  SmoothPanelResult continued = press.judge(bound_addition(clamped_move, *continued_move));
  continued.report.work += clamped.report.work;
  clamped.report.work = continued.report.work;
  const std::optional<Deviations> deviations = find_less_even(continued.report, clamped.report);
  const bool moves = moves_anything(continued.report);
  if (!moves_anything(clamped.report) || (moves && !deviations)) return continued;
  clamped.report.notes.push_back(explain_clamped(moves, deviations));
  return clamped;
}

using MakeSurface = std::function<std::unique_ptr<ControlledSurface>()>;

class HeldBorderPress : public Press {
 public:
  // `make_clamped` is asked where the border of `surface` continues the curvature; `partner` (#C or empty) are the
  // mirror images of control vertices by whose limits amounts are narrowed.
  HeldBorderPress(std::unique_ptr<ControlledSurface> surface, const MakeSurface& make_clamped,
                  const SmoothPanelOptions& options, IndexVector partner = {})
      : surface_(std::move(surface)), press_(*surface_, options), partner_(std::move(partner)) {
    if (surface_->optimizer().internals().border.empty()) return;
    clamped_surface_ = make_clamped();
    clamped_press_ = std::make_unique<Restoration>(*clamped_surface_, options);
  }

  SmoothPanelResult run(const PressAmount& amount) override {
    PressAmount own = amount;
    own.limit_range = intersect_limits(amount.limit_range, partner_);
    if (!clamped_press_) return press_.run(own);
    own.judged = true;  // the measures choose between both
    return press_both(press_, *clamped_press_, own);
  }

 private:
  std::unique_ptr<ControlledSurface> surface_;
  Restoration press_;
  IndexVector partner_;
  std::unique_ptr<ControlledSurface> clamped_surface_;  // or none
  std::unique_ptr<Restoration> clamped_press_;
};

}  // namespace

std::unique_ptr<Press> prepare_held_border(const Positions& V, const Triangles& F, const Vector3& view,
                                           const std::vector<Vector3>& families, const ShapeOptions& shape,
                                           const SmoothPanelOptions& options) {
  const auto make = [&](const ShapeOptions& own) { return std::make_unique<MeshSurface>(V, F, view, families, own); };
  return std::make_unique<HeldBorderPress>(
      make(shape), [&] { return make(clamp_instead(shape)); }, options);
}

std::unique_ptr<Press> prepare_cage(const JointCage& cage, const Vector3& view, const Vector3& lines,
                                    const SmoothPanelOptions& options, const PressAmount& amount) {
  CageOptions own = cage.options;
  set_restoration_rules(options, lines, amount, kRules.cage.proximity, own.shape);
  const auto make = [&](const CageOptions& chosen) {
    return std::make_unique<CageControlledSurface>(cage.cage, cage.V, view, make_families(view, lines, options),
                                                   chosen);
  };
  CageOptions clamped = own;
  clamp_all(clamped.border);
  return std::make_unique<HeldBorderPress>(
      make(own), [&] { return make(clamped); }, options, cage.options.partner);
}

}  // namespace reflines

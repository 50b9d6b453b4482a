// The steps of the presses of Smooth on one surface, for meshes and cages alike: see panel_smoother.h. The flaws are
// found once, and so are what the presses after the first need of the solve and of the measures.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/panel_smoother.h"
#include "reflines/smooth_panel.h"
#include "restoration/adaptive_smoother.h"
#include "restoration/control_range.h"
#include "restoration/controlled_surface.h"
#include "restoration/line_evenness.h"
#include "restoration/reference_shape.h"

namespace reflines {

class Restoration {
 public:
  // Keeps a reference to the surface until it is destroyed. How much of the move a press makes is not read from the
  // options, but given to each press.
  Restoration(ControlledSurface& surface, const SmoothPanelOptions& options);
  Restoration(const Restoration&) = delete;  // parts refer to others

  // Finds the flaws and solves for the shape without them. Positions (#C x 3) are those of the control vertices.
  SmoothPanelResult run(const PressAmount& amount) {
    const Vector move = find_move(amount);
    return judge(move);
  }

  Vector find_move(const PressAmount& amount);  // of the control vertices (#C), not judged yet

  // Judges a move of the control vertices (#C), after find_move or choose; `whole`, no places are left.
  SmoothPanelResult judge(const Vector& move, bool whole = false);

  void choose(const PressAmount& amount);  // for what follows, as find_move does

  // Returns the work since the last call, or since the amount was chosen.
  PressWork take_work();

  const SmoothPanelReport& report() const { return report_; }  // so far: the length from the beginning
  const Mask& limited() const { return limited_; }             // #C: those that wanted to go beyond the limit
  // Returns the fraction of a cage's move (#C) that is to be made; see CageRules.
  double weigh_gain(const Vector& move);

  bool turns_faces(const Vector& move) const;  // a move of the control vertices, by more than 45 degrees

  const Mask& held_triangles() const { return held_triangles_; }  // #F: those that would have turned too far

  // Judges a move of the control vertices (#C) that was found on a larger surface, with its report, those of them that
  // its limit holds back, and the triangles (#F) that it held.
  SmoothPanelResult judge_move(const Vector& move, const SmoothPanelReport& found, const Mask& limited,
                               const Mask& held);

 private:
  Progress* progress() const { return amount_.progress.get(); }
  void forget_shape();
  void find_shape();
  void find_unlimited();
  void solve(const MoveLimit& limit);
  Vector make_move();
  Vector read_move() const;
  Vector restore_within_limit();
  Mask find_turned_by(const Vector& move) const;
  Vector smooth(const Vector& z) const;
  Unevenness measure(const Vector& z) const;
  Unevenness measure_move(const Vector& move) const;  // of the control vertices (#C)
  const Unevenness& measure_start();
  bool has_longer_waves();
  Vector leave_uneven_places(const Vector& move, const Unevenness& after, double raised);
  void compare_with_start(const Vector& end, Unevenness after);
  Vector tell_places(const Vector& healed) const;
  SmoothPanelResult apply(const Vector& move);
  SmoothPanelResult refuse(const Note& reason);

  ControlledSurface& surface_;
  const SmoothPanelOptions options_;
  Vector3 axis_;  // of the moves
  Vector start_;  // #V, heights of the surface as its optimizer has them
  SmoothPanelReport report_;
  PressAmount amount_;
  PressWork work_;  // see take_work; that of the smoother is not in it yet
  ControlRange range_;
  Mask limited_;         // #C, see limited()
  Mask held_triangles_;  // #F, see held_triangles()

  // These are of the shape without flaws, while the same triangles are held.
  ReferenceShape reference_;
  Vector shape_;                                // #V: the heights without flaws
  std::unique_ptr<AdaptiveSmoother> smoother_;  // null: not found yet
  std::vector<Target> targets_;
  Vector unlimited_;                  // #C, the move of the solve without a limit; empty: not solved yet
  Report unlimited_solve_;            // its report
  bool at_unlimited_ = false;         // the optimizer is where that solve left it
  std::optional<Unevenness> uneven_;  // of the start
  std::optional<Vector> course_;      // #V: the heights whose lines are the course of the lines without flaws
  std::optional<double> gain_;        // see weigh_gain, of the unlimited move
  std::optional<bool> longer_waves_;  // see has_longer_waves
};

}  // namespace reflines

// The steps of one press of Smooth, for meshes and cages alike: see smooth_panel.h.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/smooth_panel.h"
#include "restoration/adaptive_smoother.h"
#include "restoration/control_range.h"
#include "restoration/controlled_surface.h"
#include "restoration/flawless_shape.h"
#include "restoration/line_evenness.h"

namespace reflines {

// Weight of staying near the shape without flaws (see Energy), where a limit or the border keeps a solve from it: the
// lines hardly see a shape that is as long as the panel. Of 0, 1e5, 1e6, 1e7, with the lines of the clean panel as
// target: 0, 0.4, 4 and 30 % left of dents, and less harm the higher. A cage has few unknowns, which drift less, and
// each lifts much surface: of 1e6, 1e5 and 1e4, 0.61, 0.50 and 0.48 left of noise in the cage of a roof, and no clean
// cage moves by more than 0.7 mm.
inline constexpr double kMeshProximity = 1e6, kCageProximity = 1e4;

class Restoration {
 public:
  // Keeps references to both until it is destroyed.
  Restoration(ControlledSurface& surface, const SmoothPanelOptions& options);
  Restoration(const Restoration&) = delete;  // parts refer to others

  // Finds the flaws and solves for the shape without them. Positions (#C x 3) are those of the control vertices.
  SmoothPanelResult run() { return judge(find_move()); }

  Vector find_move();  // of the control vertices (#C), not judged yet

  // Judges a move of the control vertices (#C), after find_move.
  SmoothPanelResult judge(const Vector& move);

  const SmoothPanelReport& report() const { return report_; }  // so far: length and limit from the beginning
  const Mask& limited() const { return limited_; }             // #C: those that wanted to go beyond the limit
  bool turns_faces(const Vector& move) const;  // a move of the control vertices, by more than 45 degrees

  const Mask& held_triangles() const { return held_triangles_; }  // #F: those that would have turned too far

  // Judges a move of the control vertices (#C) that was found on a larger surface, with its report, those of them that
  // its limit holds back, and the triangles (#F) that it held.
  SmoothPanelResult judge_move(const Vector& move, const SmoothPanelReport& found, const Mask& limited,
                               const Mask& held);

 private:
  Progress* progress() const { return options_.progress.get(); }
  void find_shape();
  Vector restore();
  void solve(const std::vector<Target>& targets, const MoveLimit& limit);
  Vector read_move() const;
  Vector restore_within_limit(const std::vector<Target>& targets);
  Mask find_turned_by(const Vector& move) const;
  Vector smooth(const Vector& z) const;
  bool find_longer_waves(const Vector& z);
  double weigh_gain(const Vector& move) const;
  SmoothPanelResult refuse(const std::string& reason);

  ControlledSurface& surface_;
  const SmoothPanelOptions& options_;
  Vector3 axis_;  // of the moves
  Vector start_;  // #V, heights of the surface as its optimizer has them
  SmoothPanelReport report_;
  ControlRange range_;
  FlawlessShape flawless_;
  Vector shape_;  // #V: the heights without flaws
  std::unique_ptr<HeightField> field_;
  std::unique_ptr<AdaptiveSmoother> smoother_;  // refers to field_
  Vector unlimited_;                            // #C, the move of the last solve
  Mask limited_;                                // #C, see limited()
  Mask held_triangles_;                         // #F, see held_triangles()
};

}  // namespace reflines

// The steps of one press of Smooth, for meshes and cages alike: see smooth_panel.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reflines/smooth_panel.h"
#include "restoration/controlled_surface.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {

// Weight of staying near the start, or the start without what was found to be bumps (see Energy): the lines hardly see
// a shape that is as long as the panel, and this keeps it where it is. Of 0, 1e5, 1e6, 1e7, with the lines of the clean
// panel as target: 0, 0.4, 4 and 30 % left of dents, and less harm the higher. A cage has few unknowns, which drift
// less, and each lifts much surface: of 1e6, 1e5 and 1e4, 0.61, 0.50 and 0.48 left of noise in the cage of a roof, and
// no clean cage moves by more than 0.7 mm.
inline constexpr double kMeshProximity = 1e6, kCageProximity = 1e4;

class Restoration {
 public:
  // Keeps references to both until it is destroyed.
  Restoration(ControlledSurface& surface, const SmoothPanelOptions& options);

  // Finds the flaws and solves for the shape without them. Positions (#C x 3) are those of the control vertices.
  SmoothPanelResult run() { return judge(find_move()); }

  Vector find_move();                                          // of the control vertices (#C), not judged yet
  const SmoothPanelReport& report() const { return report_; }  // so far: length and limit from the beginning
  const Mask& limited() const { return limited_; }             // #C: those that wanted to go beyond the limit
  bool turns_faces(const Vector& move) const;  // a move of the control vertices, by more than 45 degrees

  // Judges a move of the control vertices (#C) that was found on a larger surface, with its report and those of them
  // that its limit holds back.
  SmoothPanelResult judge_move(const Vector& move, const SmoothPanelReport& found, const Mask& limited);

 private:
  Progress* progress() const { return options_.progress.get(); }
  Vector attempt();
  Vector restore();
  const Vector& find_flawless();
  void solve(const std::vector<Target>& targets, const MoveLimit& limit);
  Vector restore_within_limit(const std::vector<Target>& targets);
  double range_towards(Eigen::Index control, double move) const;
  Vector scale_to_limit() const;
  Vector use_symmetry(const Vector& z);
  Vector remove_bumps(const Vector& z);
  Vector spare_every_light(const Vector& move);
  bool is_any_worse() const;
  std::vector<Target> plan(const Vector& z);
  std::vector<TriangleFields> smooth_further(const Vector& creases, const TriangleFields& fields) const;
  Eigen::MatrixXd weigh_changes(const std::vector<TriangleFields>& changes) const;
  bool is_held_symmetrically() const;
  Vector average_partners(const Vector& move) const;
  TriangleFields read_fields(const Vector& z);
  Positions lift(const Positions& V, const Vector& move) const;
  // Vertices of triangles that the move turns by more than 45 degrees, and the number of these triangles.
  Mask find_turned(const Vector& move) const;
  Mask find_corners(const Mask& triangles) const;
  double measure_change(const Vector& move);
  std::vector<double> measure_unevenness(const Vector& z, const Vector& creases, Vector& stray,
                                         std::vector<double>& typical);
  void measure_result(const Vector& move);
  bool keeps_longer_waves(const Vector& z);
  std::vector<LineScore> score(const Vector& z);
  bool has_gain() const;
  int find_worse_light() const;
  SmoothPanelResult judge(const Vector& move);
  void tell();

  ControlledSurface& surface_;
  const SmoothPanelOptions& options_;
  ImagePlane frame_;
  Vector start_;  // #V, heights of the surface as its optimizer has them
  SmoothPanelReport report_;
  CreasePreservingSmoother smoother_;
  Vector creases_;                                      // weights of the inner edges, of the start
  Vector common_creases_;                               // likewise, of start and result: those that both have
  bool use_smoothing_ = true;                           // false once the lines turn out to have no noise
  bool use_symmetry_ = true, use_bumps_ = true;         // false once they have made the lines less even
  std::optional<Vector> flawless_;                      // #V, see find_flawless; none once it holds no more
  Vector rest_;                                         // #V, likewise without what is surely a flaw
  std::vector<double> typical_before_, typical_after_;  // medians of the lines' stray, for each light
  IndexVector partner_;                                 // #C, see MirrorEvidence; empty: no symmetry
  MoveLimit range_;                                     // #C, lengths: the limit by each vertex's share of it
  Vector unlimited_;                                    // #C, the move of the last solve
  Mask limited_;                                        // #C, see limited()
  Vector stray_before_;                                 // SmoothPanelReport::stray of the start
};

}  // namespace reflines

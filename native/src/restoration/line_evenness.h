// Compares how even the lines of a press's start and result are, in each light: by this the press is judged.
#pragma once

#include <vector>

#include "reflines/line_score.h"
#include "reflines/progress.h"
#include "reflines/types.h"
#include "restoration/controlled_surface.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {

// Unevenness is how far the field of the lines is from itself smoothed up to the length of flaws, and up to the creases
// that start and result have in common.
class LineEvenness {
 public:
  // Keeps references to all but `start`, the heights (#V) of the surface.
  LineEvenness(ControlledSurface& surface, const CreasePreservingSmoother& smoother, Vector start, double length);

  // Finds the creases of the start, of which others are made; call it first. `progress` may be null; throws Cancelled.
  void find_creases(Progress* progress);
  const Vector& creases() const { return creases_; }  // #inner edges: weights, see CreasePreservingSmoother

  // Measures a result by the moves (#C) of the control vertices. Throws Cancelled.
  void measure(const Vector& move, Progress* progress);

  // The numbers that follow are those of the result measured last.
  struct Unevenness {
    std::vector<double> degrees;  // root mean square over the region, one for each light
    std::vector<double> typical;  // median over area, radians / length, likewise
    Vector stray;                 // see SmoothPanelReport::stray
  };
  const Unevenness& before() const { return before_; }
  const Unevenness& after() const { return after_; }

  bool has_fallen() const;            // noise, ripples or waves fell by as much as smoothing has to gain
  bool is_any_visibly_worse() const;  // some light is less even than at the start, by more than rounding

  // Returns the first light that is less even than what was gained may cost; -1 where there is none. `converged` tells
  // that the result is what was solved for.
  int find_worse_light(bool converged) const;

  // Returns whether the result has waves that are longer than the flaws; see longer_waves.h.
  bool has_longer_waves() const;

  // Returns by how much a move (#C) changes theta, degrees, in the root mean square over area and lights.
  double measure_change(const Vector& move) const;

  // Returns the scores of the lines at the length of flaws, one for each light, after a move (#C).
  std::vector<LineScore> score(const Vector& move) const;

  // Returns the share of a whole move with which no light is visibly less even than before, less a little for what it
  // rests on: the numbers measured with half of the move, and `whole`, the degrees with all of it.
  double find_bearable_share(const std::vector<double>& whole) const;

 private:
  Unevenness measure_heights(const Vector& z, const Vector& creases) const;
  Vector lift(const Vector& move) const { return start_ + surface_.surface_move(move); }
  bool has_gain() const;

  ControlledSurface& surface_;
  const CreasePreservingSmoother& smoother_;
  Vector start_;
  double length_;
  Vector creases_, common_creases_;  // of the start; of start and result: those that both have
  Vector measured_;                  // #V: heights of the result measured last
  Unevenness before_, after_;
};

}  // namespace reflines

// Smooths a height field up to a length that differs by place: fairing of minimum variation of curvature, whose weights
// are found from how the curvature varies around each place (an edge-stopping function with the structure tensor, as in
// coherence-enhancing diffusion, Weickert 1999, over a ladder of lengths).
#pragma once

#include <functional>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/progress.h"
#include "reflines/types.h"
#include "restoration/curvature_variation.h"
#include "restoration/fairing_system.h"
#include "restoration/mean_plane.h"

namespace reflines {

// A place is smoothed up to the lengths at which its curvature varies by no more than a flaw's does, and design stays.
// The curvature varies as a flaw's does where it does so slowly, everywhere alike, or in all directions; as design
// where it does strongly and at some places only, or across a direction in a band: fillets, edges and character lines
// go on, and waves across a direction are many.
class AdaptiveSmoother {
 public:
  using Correction = std::function<Vector(const Vector&)>;  // of heights, #V

  // `length` is the size of the flaws.
  AdaptiveSmoother(const HeightField& field, double length);

  // Takes round dents and bumps out of heights z along the view (#V), finds the lengths for the rest, and returns that
  // smoothed. `correct`, where there is one, returns what to add to heights without dents (#V) so that they have fewer
  // flaws; it is not asked before dents are gone, see Restoration::find_shape. `progress` may be null; throws
  // Cancelled.
  Vector adapt(const Vector& z, Progress* progress, const Correction& correct = nullptr);

  // Returns the result of `adapt` smoothed up to twice the lengths, where it has waves as long as that which do not
  // count as design. The next call of `smooth` factors its system again, in a fourteenth of the time of a press: only
  // presses with another amount smooth again, and a second factor would have to be kept for them.
  Vector smooth_further(const Vector& z, Progress* progress);

  const Vector& heights() const { return view_heights_; }  // #V: of the field, along the view

  int bumps() const { return bumps_; }  // that the last call took out

  // Returns how far each triangle of the surface (#F) counts as design since the last call of `adapt`, 0 to 1: the
  // fraction of the lengths that it was not smoothed up to. One that is not of the field, since it is turned away,
  // counts as 0.
  Vector design() const;

  PressWork take_work() { return system_.take_work(); }  // since the last call

  // Returns other heights (#V) smoothed up to the lengths found last.
  Vector smooth(const Vector& z);

 private:
  EdgeWeights presmoothing_weights() const;
  Vector take_step(const Vector& z, double smoothing_length, Progress* progress);
  Vector weigh(const Vector& z, double smoothing_length) const;
  double stiffness(double smoothing_length) const;
  double slope_unit() const;
  void factorize(Progress* progress);
  Vector adapt_over_plane(const Vector& start, const Correction& correct, Progress* progress);
  Vector smooth_over_plane(const Vector& z);
  Vector put_back(const Vector& held, Vector z) const;
  Vector take_view_heights(const Vector& z, const Vector& before, const Vector& after) const;

  Vector view_heights_;  // #V, of the field
  MeanPlane plane_;
  HeightField field_;  // over that plane
  double length_;
  CurvatureVariation variation_;
  FairingSystem system_;
  PlanePositions centers_;  // #T x 2
  Vector steepness_;        // #T: cos^4 of the angle between normal and mean normal
  EdgeWeights weight_;      // of the lengths found so far
  Vector open_;             // #T: how far each counts as flawed surface, 0 to 1
  Vector design_;           // #T
  bool further_ = false;    // the last factor is that of smooth_further
  int bumps_ = 0;
};

}  // namespace reflines

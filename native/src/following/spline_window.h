// A window of a piece that moves by smooth motions: bicubic B-splines over the image plane, sampled on few triangles.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "geometry/stencil.h"
#include "reflines/types.h"
#include "solver/coarse/knot_grid.h"

namespace reflines {

// A triangle that stands for its neighbours. A motion with the coefficients c changes the mean of its corners' heights,
// f_x, f_y, f_xx, f_xy and f_yy by D c(mode).
struct WindowSample {
  int triangle = -1;
  double area_ratio = 0.0;  // represented area / own area
  std::vector<int> mode;    // ascending
  Eigen::Matrix<double, 6, Eigen::Dynamic> D;
};

// The motions that would move a place.
struct ModeRow {
  std::vector<int> mode;  // ascending
  std::vector<double> value;
};

class SplineWindow {
 public:
  // Takes the piece's `field` and `stencils`, which outlive it, the vertices that may move (#V), and the width of a
  // cell. Where no vertex may move there is no motion.
  SplineWindow(const HeightField& field, const Stencils& stencils, const Mask& moving, double step);

  int count() const { return count_; }  // of motions
  double step() const { return grid_.step; }
  const std::vector<WindowSample>& samples() const { return samples_; }
  std::vector<int> sampled_triangles() const;
  double area_of(const WindowSample& sample) const { return field_.area(sample.triangle); }

  bool contains(const Vector2& xy) const;
  ModeRow row_at(const Vector2& xy) const;                     // of a place within the cells
  Vector2 slope_at(const Vector2& xy, const Vector& c) const;  // of the motion

  // Returns the rows of vertices that some motion moves and that are chosen (#V), one for each small part of a cell:
  // motions vary little within it.
  std::vector<ModeRow> choose_rows(const Mask& chosen) const;

  void move(const Vector& c, Vector& z) const;  // adds the motion to the heights (#V) of the vertices that may move

  // Positions of the motions among the knots: two within `bandwidth` columns and rows of each other have a sample in
  // common.
  const std::vector<int>& spline_of_mode() const { return spline_; }
  int columns() const { return grid_.columns; }
  int bandwidth() const { return bandwidth_; }

 private:
  void lay_grid(double step);
  void number_modes();
  void choose_samples();
  void fill_sample(WindowSample& sample);

  const HeightField& field_;
  const Stencils& stencils_;
  std::vector<int> moving_;  // vertices
  KnotGrid grid_;
  std::vector<int> mode_;    // of each spline, or -1
  std::vector<int> spline_;  // of each mode
  int count_ = 0, bandwidth_ = 3;
  std::vector<WindowSample> samples_;
};

}  // namespace reflines

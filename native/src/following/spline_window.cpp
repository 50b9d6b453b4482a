#include "following/spline_window.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflines {
namespace {

// The number of samples along a cell's side. With 2 and 3 a pull of half the spacing moves 2 and 0.3 % of it less.
constexpr int kSamplesAlong = 2;
// The number of parts along a cell's side of which one vertex is held.
constexpr int kRowsAlong = 4;
// The least sum of a spline's values over moving vertices, relative to a spline far from all borders.
constexpr double kSmallestSupport = 0.01;
constexpr int kCellsAround = 3;  // cells beyond the moving vertices, where splines that move them are not 0

int part_of(const KnotGrid& grid, const Vector2& xy, int along) {
  const Vector2 place = in_cells(grid, xy) * along;
  return static_cast<int>(place.y()) * (grid.columns - 3) * along + static_cast<int>(place.x());
}

Vector2 middle_of(const HeightField& field, int t) {
  return (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))).transpose() / 3;
}

}  // namespace

SplineWindow::SplineWindow(const HeightField& field, const Stencils& stencils, const Mask& moving, double step)
    : field_(field), stencils_(stencils) {
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (moving(v) && field.role[v] == VertexRole::kFree) moving_.push_back(v);
  }
  if (moving_.empty()) return;
  lay_grid(step);
  number_modes();
  choose_samples();
}

void SplineWindow::lay_grid(double step) {
  grid_.step = step;
  const PlanePositions places = field_.xy(moving_, Eigen::all);
  grid_.origin = places.colwise().minCoeff().transpose() - Vector2::Constant(kCellsAround * step);
  const Vector2 cells = in_cells(grid_, places.colwise().maxCoeff().transpose());
  grid_.columns = static_cast<int>(cells.x()) + kCellsAround + 4;
  grid_.rows = static_cast<int>(cells.y()) + kCellsAround + 4;
}

bool SplineWindow::contains(const Vector2& xy) const {
  const Vector2 place = in_cells(grid_, xy);
  return count_ > 0 && place.minCoeff() >= 0 && place.x() < grid_.columns - 3 && place.y() < grid_.rows - 3;
}

void SplineWindow::number_modes() {
  std::vector<double> support(static_cast<size_t>(grid_.columns) * grid_.rows, 0.0);
  double area = 0, count = 0;
  for (const int v : moving_) {
    const Footprint print = footprint(grid_, field_.xy.row(v));
    for (int k = 0; k < 16; ++k) support[print.spline[k]] += print.value[k];
    for (int e = field_.triangles_of_vertex.begin(v); e < field_.triangles_of_vertex.end(v); ++e) {
      area += field_.area(field_.triangles_of_vertex.items[e]) / 3;
    }
    ++count;
  }
  const double full = count / area * grid_.step * grid_.step;
  mode_.assign(support.size(), -1);
  for (size_t s = 0; s < support.size(); ++s) {
    if (support[s] < kSmallestSupport * full) continue;
    mode_[s] = count_++;
    spline_.push_back(static_cast<int>(s));
  }
}

ModeRow SplineWindow::row_at(const Vector2& xy) const {
  ModeRow row;
  const Footprint print = footprint(grid_, xy);
  for (int k = 0; k < 16; ++k) {
    if (mode_[print.spline[k]] < 0) continue;
    row.mode.push_back(mode_[print.spline[k]]);
    row.value.push_back(print.value[k]);
  }
  return row;
}

Vector2 SplineWindow::slope_at(const Vector2& xy, const Vector& c) const {
  const Vector2 place = in_cells(grid_, xy);
  const Eigen::Vector2i cell = place.cast<int>();
  const SplineDerivatives D = spline_derivatives(place - cell.cast<double>(), grid_.step);
  const std::array<int, 16> splines = splines_of_cell(grid_, cell.x(), cell.y());
  Vector2 slope = Vector2::Zero();
  for (int k = 0; k < 16; ++k) {
    if (mode_[splines[k]] >= 0) slope += c(mode_[splines[k]]) * D.col(k).segment<2>(1);
  }
  return slope;
}

std::vector<ModeRow> SplineWindow::choose_rows(const Mask& chosen) const {
  std::vector<ModeRow> rows;
  std::vector<bool> taken(static_cast<size_t>(grid_.columns) * grid_.rows * kRowsAlong * kRowsAlong, false);
  for (int v = 0; v < field_.vertex_count(); ++v) {
    const Vector2 xy = field_.xy.row(v);
    if (!chosen(v) || field_.role[v] == VertexRole::kUnused || !contains(xy)) continue;
    const int part = part_of(grid_, xy, kRowsAlong);
    if (taken[part]) continue;
    taken[part] = true;
    ModeRow row = row_at(xy);
    if (!row.mode.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

void SplineWindow::move(const Vector& c, Vector& z) const {
  const auto count = static_cast<Eigen::Index>(moving_.size());
#pragma omp parallel for schedule(static) if (count > kWorthThreads)
  for (Eigen::Index n = 0; n < count; ++n) {
    const Footprint print = footprint(grid_, field_.xy.row(moving_[n]));
    double sum = 0;
    for (int k = 0; k < 16; ++k) {
      if (mode_[print.spline[k]] >= 0) sum += print.value[k] * c(mode_[print.spline[k]]);
    }
    z(moving_[n]) += sum;
  }
}

// Chooses for each part of a cell the triangle nearest to its middle, standing for all.
void SplineWindow::choose_samples() {
  struct Part {
    int triangle = -1;
    double distance = 0.0, area = 0.0;
  };
  std::vector<Part> parts(static_cast<size_t>(grid_.columns) * grid_.rows * kSamplesAlong * kSamplesAlong);
  for (int t = 0; t < field_.triangle_count(); ++t) {
    const Vector2 middle = middle_of(field_, t);
    if (!contains(middle)) continue;
    const Vector2 place = in_cells(grid_, middle) * kSamplesAlong;
    const double distance = (place.array() - place.array().floor() - 0.5).matrix().squaredNorm();
    Part& part = parts[part_of(grid_, middle, kSamplesAlong)];
    part.area += field_.area(t);
    if (part.triangle >= 0 && distance >= part.distance) continue;
    part.triangle = t;
    part.distance = distance;
  }
  for (const Part& part : parts) {
    if (part.triangle < 0) continue;
    WindowSample sample{part.triangle, part.area / field_.area(part.triangle), {}, {}};
    fill_sample(sample);
    if (!sample.mode.empty()) samples_.push_back(std::move(sample));
  }
}

// Fills the derivatives of all motions at a sample: those of its stencil. Vertices that stay have none.
void SplineWindow::fill_sample(WindowSample& sample) {
  const int t = sample.triangle, first = stencils_.offset[t], last = stencils_.offset[t + 1];
  Eigen::Vector2i low = Eigen::Vector2i::Constant(1 << 30), high = -low;
  for (int e = first; e < last; ++e) {
    const Vector2 xy = field_.xy.row(stencils_.vertex[e]);
    if (!contains(xy)) continue;
    const Eigen::Vector2i cell = in_cells(grid_, xy).cast<int>();
    low = low.cwiseMin(cell);
    high = high.cwiseMax(cell + Eigen::Vector2i::Constant(3));
  }
  if (low.x() > high.x()) return;
  const int across = high.x() - low.x() + 1, along = high.y() - low.y() + 1;
  Eigen::Matrix<double, 6, Eigen::Dynamic> D = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, across * along);
  for (int e = first; e < last; ++e) {
    const Vector2 xy = field_.xy.row(stencils_.vertex[e]);
    if (!contains(xy)) continue;
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    weight.tail<3>() = stencils_.hessian.row(e).transpose();
    if (e - first < 3) {
      weight(0) = 1.0 / 3;
      weight.segment<2>(1) = stencils_.gradient.block<1, 2>(t, 2 * (e - first)).transpose();
    }
    const Footprint print = footprint(grid_, xy);
    for (int k = 0; k < 16; ++k) {
      const int i = print.spline[k] % grid_.columns - low.x(), j = print.spline[k] / grid_.columns - low.y();
      D.col(j * across + i) += print.value[k] * weight;
    }
  }
  std::vector<int> columns;
  for (int k = 0; k < across * along; ++k) {
    const int mode = mode_[(low.y() + k / across) * grid_.columns + low.x() + k % across];
    if (mode < 0 || D.col(k).isZero(0.0)) continue;
    columns.push_back(k);
    sample.mode.push_back(mode);
  }
  sample.D = D(Eigen::all, columns);
  bandwidth_ = std::max({bandwidth_, across - 1, along - 1});
}

std::vector<int> SplineWindow::sampled_triangles() const {
  std::vector<int> result;
  for (const WindowSample& sample : samples_) result.push_back(sample.triangle);
  return result;
}

}  // namespace reflines

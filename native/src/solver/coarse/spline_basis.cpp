#include "solver/coarse/spline_basis.h"

#include <algorithm>
#include <cmath>

namespace reflines {
namespace {

// The least sum of a spline's values over the vertices, relative to a spline far from all borders: a spline with less
// (at a free corner of the region inside its rim) hardly moves a vertex, and no sample determines it.
constexpr double kSmallestSupport = 0.03;

// The number of samples along a cell's side. Nine a cell are eighteen equations for each spline.
constexpr int kSamplesAlong = 3;

// The number of splines for each vertex above which there is no basis: where the region is far smaller than the box
// around it, as two mirror halves of a car's corners are, the grid is nearly empty, and takes gigabytes.
constexpr double kMostSplines = 4.0;

KnotGrid build_grid(const HeightField& field, double spacing) {
  KnotGrid grid;
  grid.step = spacing * std::sqrt(field.area.sum() / std::max(1, field.vertex_count()));
  grid.origin = field.xy.colwise().minCoeff();
  const Vector2 cells = (field.xy.colwise().maxCoeff().transpose() - grid.origin) / grid.step;
  if (!((cells.x() + 4) * (cells.y() + 4) <= kMostSplines * field.vertex_count())) return grid;
  grid.columns = static_cast<int>(cells.x()) + 4;
  grid.rows = static_cast<int>(cells.y()) + 4;
  return grid;
}

void number_splines(const HeightField& field, double full_support, SplineBasis& modes) {
  std::vector<double> support(static_cast<size_t>(modes.grid.columns) * modes.grid.rows, 0.0);
  std::vector<bool> held(support.size(), false);
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kUnused) continue;
    const Footprint print = footprint(modes.grid, field.xy.row(v));
    for (int k = 0; k < 16; ++k) {
      support[print.spline[k]] += print.value[k];
      if (field.role[v] != VertexRole::kFree && print.value[k] > 0) held[print.spline[k]] = true;
    }
  }
  modes.mode.assign(support.size(), -1);
  for (size_t s = 0; s < support.size(); ++s) {
    if (!held[s] && support[s] >= kSmallestSupport * full_support) modes.mode[s] = modes.count++;
  }
}

PlanePositions collect_free_places(const HeightField& field) {
  std::vector<int> free;
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kFree) free.push_back(v);
  }
  return field.xy(free, Eigen::all);
}

// Chooses for each part of a cell the triangle nearest to its middle, standing for all; cell by cell, with space for
// every part.
std::vector<SplineSample> choose_samples(const HeightField& field, const KnotGrid& grid) {
  constexpr int kParts = kSamplesAlong * kSamplesAlong;
  std::vector<SplineSample> samples(static_cast<size_t>(grid.columns - 3) * (grid.rows - 3) * kParts);
  std::vector<double> distance(samples.size());
  for (int t = 0; t < field.triangle_count(); ++t) {
    const Vector2 centre =
        (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))).transpose() / 3;
    const Vector2 place = in_cells(grid, centre);
    const Eigen::Vector2i cell = place.cast<int>();
    const Vector2 within = place - cell.cast<double>();
    const Eigen::Vector2i part = (kSamplesAlong * within).cast<int>();
    const size_t at =
        (static_cast<size_t>(cell.y()) * (grid.columns - 3) + cell.x()) * kParts + part.y() * kSamplesAlong + part.x();
    const double off = (kSamplesAlong * within - part.cast<double>() - Vector2(0.5, 0.5)).squaredNorm();
    samples[at].area_ratio += field.area(t);
    if (samples[at].triangle >= 0 && off >= distance[at]) continue;
    samples[at].triangle = t;
    samples[at].place = within;
    distance[at] = off;
  }
  return samples;
}

void add_cells(const HeightField& field, SplineBasis& modes) {
  const std::vector<SplineSample> samples = choose_samples(field, modes.grid);
  const int columns = modes.grid.columns - 3, parts = kSamplesAlong * kSamplesAlong;
  for (int c = 0; c < columns * (modes.grid.rows - 3); ++c) {
    SplineCell cell{static_cast<int>(modes.samples.size()), 0, splines_of_cell(modes.grid, c % columns, c / columns)};
    for (int& mode : cell.mode) mode = modes.mode[mode];
    if (*std::max_element(cell.mode.begin(), cell.mode.end()) < 0) continue;
    for (int k = c * parts; k < (c + 1) * parts; ++k) {
      if (samples[k].triangle < 0) continue;
      modes.samples.push_back(samples[k]);
      modes.samples.back().area_ratio /= field.area(samples[k].triangle);
    }
    cell.end = static_cast<int>(modes.samples.size());
    if (cell.begin < cell.end) modes.cells.push_back(cell);
  }
}

}  // namespace

SplineBasis build_spline_basis(const HeightField& field, double spacing) {
  SplineBasis modes;
  modes.grid = build_grid(field, spacing);
  if (modes.grid.columns == 0) return modes;
  number_splines(field, spacing * spacing, modes);
  modes.places = collect_free_places(field);
  if (modes.count > 0) add_cells(field, modes);
  return modes;
}

void SplineBasis::move(const Vector& c, Vector& x) const {
#pragma omp parallel for schedule(static) if (x.size() > kWorthThreads)
  for (Eigen::Index n = 0; n < x.size(); ++n) {
    add_move(places.row(n), c, x(n));
    if (images.rows() > 0) add_move(images.row(n), c, x(n));
  }
}

void SplineBasis::add_move(const Vector2& place, const Vector& c, double& x) const {
  const Footprint print = footprint(grid, place);
  for (int k = 0; k < 16; ++k) {
    if (mode[print.spline[k]] >= 0) x += vertex_weight() * print.value[k] * c(mode[print.spline[k]]);
  }
}

Vector SplineBasis::pull_back(const Vector& gradient) const {
  Vector result = Vector::Zero(count);
  for (Eigen::Index n = 0; n < gradient.size(); ++n) {
    add_gradient(places.row(n), vertex_weight() * gradient(n), result);
    if (images.rows() > 0) add_gradient(images.row(n), vertex_weight() * gradient(n), result);
  }
  return result;
}

void SplineBasis::add_gradient(const Vector2& place, double gradient, Vector& result) const {
  const Footprint print = footprint(grid, place);
  for (int k = 0; k < 16; ++k) {
    if (mode[print.spline[k]] >= 0) result(mode[print.spline[k]]) += print.value[k] * gradient;
  }
}

}  // namespace reflines

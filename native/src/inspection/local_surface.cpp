#include "inspection/local_surface.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel_failure.h"
#include "reflection/weighted_median.h"
#include "restoration/grid_cell.h"

namespace reflines {
namespace {

constexpr int kTerms = 15;                   // of a polynomial of degree 4
constexpr int kRounds = 8;                   // of reweighting
constexpr double kOutlier = 3.0;             // medians of the misfit
constexpr double kExact = 3e-6;              // of the radius: a smaller misfit is none
constexpr double kRim = 1e-3;                // weight of a vertex at the rim of its disk
constexpr double kRidge = 1e-13;             // of the trace: terms that the vertices do not determine are 0
constexpr size_t kMostSamples = 400;         // more only cost time
constexpr double kSpacing = 0.5;             // of the disks, in radii
constexpr double kBlended = 1.2 * kSpacing;  // in radii: how far from its centre a polynomial counts
constexpr size_t kNeeded[] = {16, 26, 40};   // vertices for degrees 2, 3 and 4: more than twice their terms

using Terms = Eigen::Matrix<double, kTerms, 1>;

Terms evaluate_terms(const Vector2& p) {
  Terms result;
  for (int degree = 0, first = 0; degree <= 4; first += ++degree) {
    double x = 1;
    for (int j = 0; j <= degree; ++j, x *= p.x()) result(first + j) = x;
    double y = 1;
    for (int j = degree; j >= 0; --j, y *= p.y()) result(first + j) *= y;
  }
  return result;
}

int count_terms(size_t samples) {
  int degree = 1;
  for (const size_t needed : kNeeded) degree += samples >= needed;
  return degree == 1 ? 0 : (degree + 1) * (degree + 2) / 2;
}

// A polynomial over one disk; it has no terms where there are too few vertices.
class LocalFit {
 public:
  LocalFit() = default;

  LocalFit(const HeightField& field, const std::vector<int>& sample, const Vector2& center, double radius)
      : center_(center), radius_(radius), terms_(count_terms(sample.size())) {
    if (terms_ == 0) return;
    for (const int v : sample) origin_ += field.xy.row(v).transpose() / static_cast<double>(sample.size());
    const auto count = static_cast<Eigen::Index>(sample.size());
    Eigen::MatrixXd basis(count, terms_);
    Vector z(count), taper(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vector2 p = field.xy.row(sample[k]);
      basis.row(k) = evaluate_terms((p - origin_) / radius_).head(terms_);
      z(k) = field.z(sample[k]);
      taper(k) = std::max(1 - (p - center).squaredNorm() / (radius * radius), kRim);
    }
    fit(basis, z, taper);
  }

  bool is_known() const { return terms_ > 0; }

  // Returns how much the polynomial counts at a place, 0 beyond its radius.
  double weight(const Vector2& p) const {
    const double left = std::max(1 - (p - center_).squaredNorm() / std::pow(kBlended * radius_, 2), 0.0);
    return left * left;
  }

  double height(const Vector2& p) const { return factor_.dot(evaluate_terms((p - origin_) / radius_)); }

 private:
  void fit(const Eigen::MatrixXd& basis, const Vector& z, const Vector& taper) {
    Vector weight = taper;
    for (int round = 0; round <= kRounds; ++round) {
      const Eigen::MatrixXd weighted = weight.asDiagonal() * basis;
      Eigen::MatrixXd normal = basis.transpose() * weighted;
      normal.diagonal().array() += kRidge * normal.trace();
      factor_.head(terms_) = normal.ldlt().solve(weighted.transpose() * z);
      const Vector misfit = (z - basis * factor_.head(terms_)).cwiseAbs();
      const double scale = kOutlier * weighted_median(misfit, taper) + kExact * radius_;
      weight = taper.array() / (1 + (misfit.array() / scale).square()).square();
    }
  }

  Vector2 center_ = Vector2::Zero(), origin_ = Vector2::Zero();
  double radius_ = 1.0;
  Terms factor_ = Terms::Zero();
  int terms_ = 0;
};

// Returns the vertices of each piece in the cells of a grid.
std::vector<GridCells> sort_vertices(const HeightField& field, double spacing) {
  const Incidence& around = field.triangles_of_vertex;
  std::vector<GridCells> result(field.piece_count);
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (around.begin(v) == around.end(v)) continue;
    result[field.piece[around.items[around.begin(v)]]][find_grid_cell(field.xy.row(v), spacing)].push_back(v);
  }
  return result;
}

// Returns the vertices of a disk; of many some, picked at random.
std::vector<int> gather(const HeightField& field, const GridCells& cells, const GridCell& cell, const Vector2& center,
                        double radius) {
  std::vector<int> found;
  for_each_near(cells, cell, static_cast<int>(std::ceil(1 / kSpacing)) + 1, [&](int v) {
    if ((field.xy.row(v).transpose() - center).squaredNorm() < radius * radius) found.push_back(v);
  });
  thin_out(found, kMostSamples);
  return found;
}

// Fits a disk around the centre of each cell.
std::vector<LocalFit> fit_disks(const HeightField& field, const GridCells& cells, const std::vector<GridCell>& keys,
                                double radius, const Progress* progress) {
  std::vector<LocalFit> result(keys.size());
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic, 8)
  for (size_t k = 0; k < keys.size(); ++k) {
    failure.run([&] {
      throw_if_cancelled(progress);
      const Vector2 center = kSpacing * radius * Vector2(keys[k].first + 0.5, keys[k].second + 0.5);
      result[k] = LocalFit(field, gather(field, cells, keys[k], center, radius), center, radius);
    });
  }
  failure.rethrow();
  return result;
}

}  // namespace

Vector fit_local_surface(const HeightField& field, double radius, const Progress* progress) {
  Vector sum = Vector::Zero(field.vertex_count()), weights = sum;
  for (const GridCells& cells : sort_vertices(field, kSpacing * radius)) {
    std::vector<GridCell> keys;
    for (const auto& entry : cells) keys.push_back(entry.first);
    const std::vector<LocalFit> fits = fit_disks(field, cells, keys, radius, progress);
    for (size_t k = 0; k < keys.size(); ++k) {
      if (!fits[k].is_known()) continue;
      for_each_near(cells, keys[k], 1, [&](int v) {
        const double weight = fits[k].weight(field.xy.row(v));
        if (weight == 0) return;
        sum(v) += weight * fits[k].height(field.xy.row(v));
        weights(v) += weight;
      });
    }
  }
  for (int v = 0; v < field.vertex_count(); ++v) sum(v) = weights(v) > 0 ? sum(v) / weights(v) : field.z(v);
  return sum;
}

}  // namespace reflines

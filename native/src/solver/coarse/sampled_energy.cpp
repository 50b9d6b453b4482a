#include "solver/coarse/sampled_energy.h"

#include <algorithm>
#include <functional>

namespace reflines {
namespace {

Eigen::Matrix<double, 16, 1> gather_coefficients(const SplineCell& cell, const Vector& c) {
  Eigen::Matrix<double, 16, 1> result;
  for (int k = 0; k < 16; ++k) result(k) = cell.mode[k] < 0 ? 0.0 : c(cell.mode[k]);
  return result;
}

// Calls visit(k, row, column) for the k-th pair of a cell's modes in its lower triangle. A cell's modes ascend.
void for_each_pair(const SplineCell& cell, const std::function<void(int, int, int)>& visit) {
  for (int j = 0, k = 0; j < 16; ++j) {
    for (int i = j; i < 16; ++i, ++k) {
      if (cell.mode[i] >= 0 && cell.mode[j] >= 0) visit(k, cell.mode[i], cell.mode[j]);
    }
  }
}

}  // namespace

SampledEnergy::SampledEnergy(const HeightField& field, const Energy& energy, const SplineBasis& modes, const Vector& z)
    : energy_(energy), modes_(modes), start_(modes.samples.size()) {
  for (size_t s = 0; s < start_.size(); ++s) {
    const int t = modes.samples[s].triangle;
    start_[s].u << energy.measure_mean_rise(field.F.row(t), z), apply_stencil(energy.stencils(), t, z);
    start_[s].pull = energy.pull_density() * field.area(t);
  }
  make_pattern();
}

SampledEnergy::MovedSample SampledEnergy::move_sample(int s, const Coefficients& own) const {
  const SplineSample& sample = modes_.samples[s];
  const SplineDerivatives D = spline_derivatives(sample.place, modes_.grid.step);
  return {sample, D, start_[s].u + D * own};
}

double SampledEnergy::evaluate(const Vector& c, Vector* gradient) const {
  double sum = 0;
  if (gradient) gradient->setZero();
  for (const SplineCell& cell : modes_.cells) {
    const Coefficients own = gather_coefficients(cell, c);
    Coefficients slope = Coefficients::Zero();
    for (int s = cell.begin; s < cell.end; ++s) {
      const auto& [sample, D, u] = move_sample(s, own);
      Vector5 y = Vector5::Zero();
      sum += sample.area_ratio *
             (energy_.triangle(sample.triangle, u.tail<5>(), gradient ? &y : nullptr) + start_[s].pull * u(0) * u(0));
      slope +=
          sample.area_ratio * (D.bottomRows<5>().transpose() * y + 2 * start_[s].pull * u(0) * D.row(0).transpose());
    }
    for (int k = 0; k < 16 && gradient; ++k) {
      if (cell.mode[k] >= 0) (*gradient)(cell.mode[k]) += slope(k);
    }
  }
  return sum;
}

SampledEnergy::Block SampledEnergy::block(const SplineCell& cell, const Vector& c, HessianModel model) const {
  const Coefficients own = gather_coefficients(cell, c);
  Block result = Block::Zero();
  for (int s = cell.begin; s < cell.end; ++s) {
    const auto& [sample, D, u] = move_sample(s, own);
    const Matrix5 M = sample.area_ratio * energy_.triangle_hessian(sample.triangle, u.tail<5>(), model);
    const Eigen::Matrix<double, 5, 16> MD = M * D.bottomRows<5>();
    result.noalias() += D.bottomRows<5>().transpose() * MD;
    if (start_[s].pull > 0) result += 2 * sample.area_ratio * start_[s].pull * D.row(0).transpose() * D.row(0);
  }
  return result;
}

const SparseMatrix& SampledEnergy::hessian(const Vector& c, HessianModel model) {
  H_.coeffs().setZero();
  for (size_t k = 0; k < modes_.cells.size(); ++k) {
    const Block own = block(modes_.cells[k], c, model);
    const int* position = positions_[k].data();
    for (int j = 0; j < 16; ++j) {
      for (int i = j; i < 16; ++i, ++position) {
        if (*position >= 0) H_.valuePtr()[*position] += own(i, j);
      }
    }
  }
  return H_;
}

void SampledEnergy::make_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const SplineCell& cell : modes_.cells) {
    for_each_pair(cell, [&](int, int row, int column) { entries.emplace_back(row, column, 0.0); });
  }
  for (int mode = 0; mode < modes_.count; ++mode) entries.emplace_back(mode, mode, 0.0);
  H_.resize(modes_.count, modes_.count);
  H_.setFromTriplets(entries.begin(), entries.end());
  positions_.resize(modes_.cells.size());
  for (size_t c = 0; c < positions_.size(); ++c) {
    positions_[c].fill(-1);
    for_each_pair(modes_.cells[c], [&](int k, int row, int column) {
      const int* rows = H_.innerIndexPtr();
      const int* place =
          std::lower_bound(rows + H_.outerIndexPtr()[column], rows + H_.outerIndexPtr()[column + 1], row);
      positions_[c][k] = static_cast<int>(place - rows);
    });
  }
}

}  // namespace reflines

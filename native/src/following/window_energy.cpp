#include "following/window_energy.h"

namespace reflines {
namespace {

// The weight of a vertex that stays, relative to the mean diagonal entry of the Hessian.
constexpr double kStill = 1e4;

}  // namespace

WindowEnergy::WindowEnergy(const SplineWindow& window, const Energy& energy, const Vector& z,
                           const std::vector<ModeRow>& still, double pull_density)
    : window_(window),
      energy_(energy),
      still_(still),
      start_(window.samples().size(), 5),
      pull_(window.samples().size()),
      sum_(window) {
  for (int s = 0; s < pull_.size(); ++s) {
    const WindowSample& sample = window.samples()[s];
    start_.row(s) = apply_stencil(energy.stencils(), s, z).transpose();
    pull_(s) = pull_density * sample.area_ratio * window.area_of(sample);
  }
}

// Returns the rise of the mean of the corners and the derivatives at a sample.
WindowEnergy::State WindowEnergy::move(int s, const Vector& c) const {
  const WindowSample& sample = window_.samples()[s];
  State u;
  u << 0.0, start_.row(s).transpose();
  for (size_t k = 0; k < sample.mode.size(); ++k) u += c(sample.mode[k]) * sample.D.col(static_cast<Eigen::Index>(k));
  return u;
}

double WindowEnergy::evaluate(const Vector& c, Vector* gradient) {
  if (still_weight_ == 0) hessian(c, HessianModel::kGaussNewton);
  double energy = 0;
  if (gradient) gradient->setZero();
  for (int s = 0; s < start_.rows(); ++s) {
    const WindowSample& sample = window_.samples()[s];
    const State u = move(s, c);
    Vector5 slopes = Vector5::Zero();
    energy += energy_.triangle(s, u.tail<5>(), gradient ? &slopes : nullptr) + pull_(s) * u(0) * u(0);
    if (!gradient) continue;
    State y;
    y << 2 * pull_(s) * u(0), slopes;
    for (size_t k = 0; k < sample.mode.size(); ++k) {
      (*gradient)(sample.mode[k]) += y.dot(sample.D.col(static_cast<Eigen::Index>(k)));
    }
  }
  for (const ModeRow& row : still_) {
    double off = 0;
    for (size_t k = 0; k < row.mode.size(); ++k) off += row.value[k] * c(row.mode[k]);
    energy += still_weight_ * off * off;
    for (size_t k = 0; gradient && k < row.mode.size(); ++k) {
      (*gradient)(row.mode[k]) += 2 * still_weight_ * off * row.value[k];
    }
  }
  return energy;
}

const SparseMatrix& WindowEnergy::hessian(const Vector& c, HessianModel model) {
  sum_.clear();
  Eigen::Matrix<double, 6, Eigen::Dynamic> MD;
  Eigen::MatrixXd block;
  for (int s = 0; s < start_.rows(); ++s) {
    const WindowSample& sample = window_.samples()[s];
    Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Zero();
    M(0, 0) = 2 * pull_(s);
    M.bottomRightCorner<5, 5>() = energy_.triangle_hessian(s, move(s, c).tail<5>(), model);
    MD.noalias() = M * sample.D;
    block.noalias() = sample.D.transpose() * MD;
    sum_.add(sample.mode, block);
  }
  if (still_weight_ == 0) still_weight_ = kStill * sum_.mean_diagonal();
  for (const ModeRow& row : still_) sum_.add(row, 2 * still_weight_);
  return sum_.matrix();
}

}  // namespace reflines

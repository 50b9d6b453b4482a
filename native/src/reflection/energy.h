// E(z) = sum over terms and triangles of c_T A_T |grad theta_T(z) - wanted_T|^2 (eq. 4; eq. 3 for value fits), plus a
// weak quadratic pull to the start. It is a function of the heights of all vertices.
#pragma once

#include <vector>

#include "geometry/derivatives.h"
#include "reflection/element.h"
#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

// The fit of one family of light lines to one target; rows are this energy's own triangles.
struct EnergyTerm {
  ReflectionFunction reflection;
  PlaneVectors gradient;  // #T x 2
  Vector theta;           // #T for a value fit, else empty
  Vector weight;          // #T: c_T A_T (of values times 1 / length^2), and 0 where theta is not defined
};

class Energy {
 public:
  // Takes `field` and `stencils`, which must outlive the energy. The proximity term is proximity / diagonal^4 sum_v A_v
  // (z_v - start_v)^2: the factor makes it comparable with |grad theta|^2 whatever the unit of length. 0 switches it
  // off.
  Energy(const HeightField& field, const Stencils& stencils, double proximity);

  void set_terms(std::vector<EnergyTerm> terms) { terms_ = std::move(terms); }

  void set_start(const Vector& z) { start_ = z; }  // #V: rest heights of the pull
  // Adds a pull weight (z - start)^2, #V each, to the proximity term (where that is switched off, too).
  void pull_to(const Vector& z, const Vector& weight);
  void pull_as_built(const Vector& z);  // restores the proximity term alone, with rest heights z

  // Returns the only term, or null where there are several.
  const EnergyTerm* only_term() const { return terms_.size() == 1 ? terms_.data() : nullptr; }

  // Returns E(z), and writes dE/dz (#V) into `gradient` where it is not null.
  double evaluate(const Vector& z, Vector* gradient);

  const Vector& triangle_energies() const { return triangle_energy_; }  // #T: of the last evaluation, without the pull

  // The #T matrices D_T^T M_T D_T of the second-order model at z by their M_T: the upper triangle row by row (15
  // numbers).
  using ElementHessians = Eigen::Matrix<double, Eigen::Dynamic, 15, Eigen::RowMajor>;
  // Computes them at z; they are overwritten by the next call.
  const ElementHessians& element_hessians(const Vector& z, HessianModel model);

  // Returns the diagonal of the pull's Hessian (#V).
  Vector proximity_hessian() const { return 2 * pull_; }

  // Return the energy of one triangle without the pull as a function of its derivatives u, and its second-order model.
  double triangle(int t, const Vector5& u, Vector5* gradient) const;  // adds to `gradient` where it is not null
  Matrix5 triangle_hessian(int t, const Vector5& u, HessianModel model) const;

  // Return the pull as a field: its weight for one unit of area, and the height of z above its rest at a triangle's
  // corners.
  double pull_density() const { return pull_density_; }
  double measure_mean_rise(const Eigen::RowVector3i& corners, const Vector& z) const;

  const Stencils& stencils() const { return stencils_; }
  const StencilEntries& entries() const { return entries_; }

 private:
  const Stencils& stencils_;
  StencilEntries entries_;
  std::vector<EnergyTerm> terms_;
  Vector start_;  // #V
  double pull_density_;
  Vector proximity_;        // #V: weight of (z - start)^2 by the proximity term; empty without one
  Vector pull_;             // #V: the same with the weights added by pull_to
  Vector triangle_energy_;  // #T, work space
  Vector products_;         // #entries, work space
  ElementHessians elements_;
};

}  // namespace reflines

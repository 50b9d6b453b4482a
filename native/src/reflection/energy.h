// E(z) = sum over terms and triangles of c_T A_T |grad theta_T(z) - wanted_T|^2 (eq. 4; eq. 3 for value fits), plus a
// weak pull towards the start. Heights of all vertices in, derivatives with respect to them out.
#pragma once

#include <vector>

#include "geometry/derivatives.h"
#include "reflection/element.h"
#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

// One target seen through one family of light lines, by this energy's own triangles.
struct EnergyTerm {
  ReflectionFunction reflection;
  PlaneVectors gradient;  // #T x 2
  Vector theta;           // #T for a value fit, else empty
  Vector weight;          // #T: c_T A_T (of values times 1 / length^2), and 0 where theta is not defined
};

class Energy {
 public:
  // `field` and `stencils` must outlive the energy. Proximity adds proximity / diagonal^4 sum_v A_v (z_v - start_v)^2:
  // the factor makes it comparable with |grad theta|^2 whatever the unit of length. 0 switches it off.
  Energy(const HeightField& field, const Stencils& stencils, double proximity);

  void set_terms(std::vector<EnergyTerm> terms) { terms_ = std::move(terms); }

  void set_start(const Vector& z) { start_ = z; }  // #V: where the pull goes to
  // #V each: what else pulls, weight (z - start)^2, beside the proximity (where that is switched off, too).
  void pull_to(const Vector& z, const Vector& weight);
  void pull_as_built(const Vector& z);  // only the proximity, to z

  // E(z); dE/dz (#V) into `gradient` where it is not null.
  double evaluate(const Vector& z, Vector* gradient);

  // #T matrices D_T^T M_T D_T of the second-order model at z: M_T for every triangle, upper triangle row by row (15
  // numbers).
  using ElementHessians = Eigen::Matrix<double, Eigen::Dynamic, 15, Eigen::RowMajor>;
  // Overwritten by the next call.
  const ElementHessians& element_hessians(const Vector& z, HessianModel model);

  // Diagonal of the proximity term's Hessian (#V).
  Vector proximity_hessian() const { return 2 * pull_; }

  // One triangle's energy without the pull as a function of its derivatives u, and its second-order model.
  double triangle(int t, const Vector5& u, Vector5* gradient) const;  // adds to `gradient` where it is not null
  Matrix5 triangle_hessian(int t, const Vector5& u, HessianModel model) const;

  // The pull as a field: its weight for one unit of area, and how far z lies above its rest over a triangle's corners.
  double pull_density() const { return pull_density_; }
  double mean_rise(const Eigen::RowVector3i& corners, const Vector& z) const;

  const Stencils& stencils() const { return stencils_; }
  const StencilEntries& entries() const { return entries_; }

 private:
  const Stencils& stencils_;
  StencilEntries entries_;
  std::vector<EnergyTerm> terms_;
  Vector start_;  // #V
  double pull_density_;
  Vector proximity_;        // #V: weight of (z - start)^2 by the proximity; empty without
  Vector pull_;             // #V: that, or what was set later
  Vector triangle_energy_;  // #T, work space
  Vector products_;         // #entries, work space
  ElementHessians elements_;
};

}  // namespace reflines

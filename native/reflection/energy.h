// E(z) = sum over terms and triangles of c_T A_T |grad theta_T(z) - wanted_T|^2 (eq. 4; eq. 3 for value fits), plus a
// weak pull towards the start. Heights of all vertices in, derivatives with respect to them out.
#pragma once

#include <vector>

#include "native/geometry/derivatives.h"
#include "native/reflection/element.h"
#include "native/reflection/target.h"
#include "native/types.h"

namespace reflines {

// One target seen through one family of light lines, by this energy's own triangles.
struct EnergyTerm {
  ReflectionFunction reflection;
  PlaneVectors gradient;  // #T x 2
  Vector theta;           // #T for a value fit, else empty
  Vector weight;          // #T: c_T A_T, and 0 where theta is not defined
};

class Energy {
 public:
  // `field` and `stencils` must outlive the energy. Proximity adds proximity / diagonal^4 sum_v A_v (z_v - start_v)^2:
  // the factor makes it comparable with |grad theta|^2 whatever the unit of length. 0 switches it off.
  Energy(const HeightField& field, const Stencils& stencils, double proximity);

  void set_terms(std::vector<EnergyTerm> terms) { terms_ = std::move(terms); }

  void set_start(const Vector& z) { start_ = z; }  // #V: where the pull goes to

  // E(z); dE/dz (#V) into `gradient` where it is not null.
  double evaluate(const Vector& z, Vector* gradient);

  // #T matrices D_T^T M_T D_T of the second-order model at z: M_T for every triangle, upper triangle row by row (15
  // numbers).
  using ElementHessians = Eigen::Matrix<double, Eigen::Dynamic, 15, Eigen::RowMajor>;
  // Overwritten by the next call.
  const ElementHessians& element_hessians(const Vector& z, HessianModel model);

  // Diagonal of the proximity term's Hessian (#V).
  Vector proximity_hessian() const { return 2 * pull_; }

  const Stencils& stencils() const { return stencils_; }
  const StencilEntries& entries() const { return entries_; }

 private:
  double sum_triangles(bool with_gradient);

  const Stencils& stencils_;
  StencilEntries entries_;
  std::vector<EnergyTerm> terms_;
  Vector start_;           // #V
  Vector pull_;            // #V: weight of (z - start)^2; empty without proximity
  TriangleDerivatives u_;  // #T x 5, work space
  TriangleDerivatives y_;  // #T x 5: dE/du
  Vector share_;           // #T: a triangle's energy
  Vector products_;        // #entries, work space
  ElementHessians elements_;
};

}  // namespace reflines

// The terms of a piece's energy that belong to targets, and the misfit of given heights.
#pragma once

#include <vector>

#include "geometry/derivatives.h"
#include "reflection/energy.h"
#include "reflines/target.h"
#include "solver/quadrature.h"

namespace reflines {

class TargetTerms {
 public:
  // Takes references that outlive the object. `trust` (#T for each family) is the weight by visibility. The last family
  // crosses the first and belongs to no target. `row_count` is the number of triangles in the energy.
  TargetTerms(const HeightField& field, const Quadrature& quadrature, const std::vector<ReflectionFunction>& families,
              const std::vector<Vector>& trust, int row_count);

  // Builds the terms of targets, whose rows follow the region's triangles. A value fit has two terms, see
  // build_companion. Throws InvalidInput where the gradient beside a value fit is not finite.
  std::vector<EnergyTerm> build(const std::vector<Target>& targets) const;

  // Builds the term whose target for the last family is its field `start` (#T x 2); `fraction` (#T) weighs triangles.
  EnergyTerm build_crossing(const PlaneVectors& start, const Vector& fraction) const;

  // The misfit of heights with the derivatives u (one row for each triangle in the energy), over the triangles that can
  // change: sum of area |grad theta - wanted|^2 (of a value fit: of the difference of theta), and of areas.
  struct Misfit {
    double squared = 0.0, area = 0.0;
  };
  Misfit measure(const std::vector<Target>& targets, const TriangleDerivatives& u) const;

  // Measures the misfit of heights z (#V) with a gradient target, the only one of `energy`, which was last evaluated
  // there: without another pass over the stencils.
  Misfit measure_evaluated(const Target& target, const Energy& energy, const Vector& z) const;

 private:
  EnergyTerm build_term(const Target& target, bool by_value) const;
  EnergyTerm build_companion(const Target& target) const;
  Misfit sum(Vector squared) const;

  const HeightField& field_;
  const Quadrature& quadrature_;
  const std::vector<ReflectionFunction>& families_;
  const std::vector<Vector>& trust_;
  int row_count_;
};

}  // namespace reflines

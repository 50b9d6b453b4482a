// The variation of curvature of a height field: how the triangles' second fundamental forms change across edges, as
// the third-order energy of minimum variation fairing (Moreton and Sequin 1992).
#pragma once

#include <vector>

#include "geometry/derivatives.h"
#include "geometry/height_field.h"
#include "geometry/stencil.h"
#include "reflection/field_average.h"
#include "reflines/types.h"
#include "restoration/triangle_fields.h"

namespace reflines {

// A weight for the edge opposite each corner (#T x 3), the same on both sides of it; 0 at an edge of one triangle.
using EdgeWeights = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// The energy is sum_e w_e a_e |B_2 - B_1|^2 / d_e^2, with the second fundamental forms B of the two triangles at an
// edge, the distance d_e of their centroids across it, and a_e, two thirds of their area. B = l S^-1 H S^-1, where H
// are the second derivatives of the heights, S the root of the metric and l the lift of the tangent plane that the
// surface has there at the start: B is linear in heights. Its frame is that of the plane, turned least; frames carried
// over each edge instead change no panel's result.
//
// Spheres have none, by which a surface that turns away from the plane is not drawn towards a flat one: by second
// derivatives instead a real bonnet's corners were bent by 0.38 degrees, not by 0.11.
//
// Of other surfaces the energy is the integral of w |grad B|^2 times a factor by the triangles' shape and direction,
// since second derivatives are exact on quadratics only: it is as if a wave were up to 1.3 times as long.
class CurvatureVariation {
 public:
  explicit CurvatureVariation(const HeightField& field);  // which outlives it

  // Returns the second derivatives (f_xx, sqrt(2) f_xy, f_yy) of heights z (#V): #T x 3.
  TriangleFields read_hessians(const Vector& z) const;

  // Returns the means of Hessians (#T x 3) over the triangles around, which keep what is linear (see FieldAverage): the
  // errors of the stencils of an irregular mesh, which alternate from triangle to triangle, have no direction.
  TriangleFields average(const TriangleFields& hessian) const;

  // Returns the matrix that turns second derivatives of triangle t, as rows from the left, into the form B.
  const Eigen::Matrix3d& form(int t) const { return form_[t]; }

  // Returns the structure tensors sum_c grad H_c (grad H_c)^T of second derivatives (#T x 3): #T x 3, xx, xy, yy, in
  // 1 / length^4. They tell what is design, which forms do not: a bent spout's vary as slowly as a flaw's, and it was
  // bent by 2.6 degrees.
  Eigen::MatrixXd read_tensors(const TriangleFields& hessian) const;

  // Returns the trace of the structure tensor of triangle t, with `hessian` returning that of a triangle (1 x 3).
  template <typename Hessian>
  double read_variation(int t, const Hessian& hessian) const {
    return differentiate(t, hessian).squaredNorm();
  }

  // Returns w_e a_e / d_e^2 for weights w_e of the edges.
  EdgeWeights scale_by_shape(const EdgeWeights& weight) const { return weight.cwiseProduct(shape_); }

  // Returns the gradient of half the energy at heights z (#V); `scaled` are weights after scale_by_shape.
  Vector differentiate(const Vector& z, const EdgeWeights& scaled) const;

  const HeightField& field() const { return field_; }
  const Stencils& stencils() const { return stencils_; }
  const StencilEntries& entries() const { return entries_; }

 private:
  std::vector<Eigen::Matrix3d> make_forms() const;

  // Returns the derivatives (3 x 2) of the Hessian along x and y in triangle t.
  template <typename Hessian>
  Eigen::Matrix<double, 3, 2> differentiate(int t, const Hessian& hessian) const {
    Eigen::Matrix<double, 3, 2> result = Eigen::Matrix<double, 3, 2>::Zero();
    const Vector3 own = hessian(t).transpose();
    for (int i = 0; i < 3; ++i) {
      const int other = field_.neighbors(t, i);
      if (other < 0) continue;
      const Vector3 change = hessian(other).transpose() - own;
      result.col(0) += slope_(t, 2 * i) * change;
      result.col(1) += slope_(t, 2 * i + 1) * change;
    }
    return result;
  }

  const HeightField& field_;
  Stencils stencils_;  // the weights of f_xy times sqrt(2)
  StencilEntries entries_;
  EdgeWeights shape_;  // a_e / d_e^2
  FieldAverage average_;
  std::vector<Eigen::Matrix3d> form_;  // #T
  // #T x 6: of each neighbour the weights (x, y) by which its difference adds to the gradient of a field on triangles,
  // by least squares over the neighbours' centroids.
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> slope_;
};

}  // namespace reflines

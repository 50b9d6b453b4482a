// The triangle-averaged Hessian: H_T = 1 / (2 A_T) sum_i sym((grad f_i - grad f_T) (x) t_i) over the edges i with a
// neighbour T_i, t_i the outward perpendicular of edge i with the edge's length (eq. 6, re-derived).
#include "geometry/stencil.h"

namespace reflines {
namespace {

Vector2 corner(const HeightField& field, int t, int i) { return field.xy.row(field.F(t, i)); }

// Returns the outward perpendicular of the edge opposite corner i, with the edge's length (counter-clockwise triangle).
Vector2 compute_outward(const HeightField& field, int t, int i) {
  const Vector2 edge = corner(field, t, (i + 2) % 3) - corner(field, t, (i + 1) % 3);
  return {edge.y(), -edge.x()};
}

// Adds sym(scale * grad f_s (x) direction) to the weights: grad f_s = -1 / (2 A_s) sum_j f_j t_j with outward t_j.
void add_gradient(const HeightField& field, int s, const Vector2& direction, double scale, HessianStencil& stencil) {
  for (int j = 0; j < 3; ++j) {
    const int v = field.F(s, j);
    size_t slot = 0;
    while (slot < stencil.vertex.size() && stencil.vertex[slot] != v) ++slot;
    if (slot == stencil.vertex.size()) stencil.vertex.push_back(v);
    const Vector2 gradient = compute_outward(field, s, j) * (-0.5 * scale / field.area(s));
    stencil.weight(0, slot) += gradient.x() * direction.x();
    stencil.weight(1, slot) += 0.5 * (gradient.x() * direction.y() + gradient.y() * direction.x());
    stencil.weight(2, slot) += gradient.y() * direction.y();
  }
}

}  // namespace

HessianStencil averaged_hessian(const HeightField& field, int t) {
  HessianStencil stencil;
  stencil.vertex = {field.F(t, 0), field.F(t, 1), field.F(t, 2)};
  stencil.weight = Eigen::Matrix3Xd::Zero(3, 6);
  const double scale = 0.5 / field.area(t);
  for (int i = 0; i < 3; ++i) {
    const int other = field.neighbors(t, i);
    if (other < 0) continue;
    const Vector2 direction = compute_outward(field, t, i);
    add_gradient(field, other, direction, scale, stencil);
    add_gradient(field, t, direction, -scale, stencil);
  }
  stencil.weight.conservativeResize(3, static_cast<int>(stencil.vertex.size()));
  return stencil;
}

}  // namespace reflines

#include "native/geometry/stencil.h"

#include <algorithm>

#include "native/errors.h"

namespace reflines {
namespace {

// The paper's C: a six-point stencil with a larger coefficient times l_max^2 counts as unstable.
constexpr double kPaperThreshold = 5.0;
// Ours. Recovering a sphere's cap on a grid jittered by 0.2 cells, 128 a side, the error is 5.0e-5 of the depth with
// the ring everywhere and 4.4e-5, 4.3e-5, 4.4e-5, 4.4e-5 for C = 5, 12, 20, 50: accuracy does not ask for the ring on
// sane stencils, and every ring costs fill. 20 leaves it to borders, valence three and points close to a conic.
constexpr double kConsistentThreshold = 20.0;

HessianStencil with_fallback(const HeightField& field, int t, StencilKind kind, bool& fell_back) {
  if (kind == StencilKind::kAveraged) return averaged_hessian(field, t);
  HessianStencil six = quadratic_hessian(field, t);
  if (kind == StencilKind::kQuadratic) return six;
  const double threshold = kind == StencilKind::kHybrid ? kPaperThreshold : kConsistentThreshold;
  if (!six.empty() && stencil_magnitude(field, six) <= threshold) return six;
  fell_back = true;
  HessianStencil other = kind == StencilKind::kConsistent ? ring_hessian(field, t) : HessianStencil();
  return other.empty() ? averaged_hessian(field, t) : other;
}

void set_gradient(const HeightField& field, int t, Stencils& stencils) {
  const Vector2 p[3] = {field.xy.row(field.F(t, 0)), field.xy.row(field.F(t, 1)), field.xy.row(field.F(t, 2))};
  for (int i = 0; i < 3; ++i) {
    const Vector2 edge = p[(i + 2) % 3] - p[(i + 1) % 3];
    stencils.gradient(t, 2 * i) = -0.5 * edge.y() / field.area(t);
    stencils.gradient(t, 2 * i + 1) = 0.5 * edge.x() / field.area(t);
  }
}

Stencils pack(const HeightField& field, const std::vector<HessianStencil>& each) {
  Stencils stencils;
  stencils.offset.push_back(0);
  for (const HessianStencil& one : each)
    stencils.offset.push_back(stencils.offset.back() + static_cast<int>(one.vertex.size()));
  stencils.vertex.reserve(stencils.offset.back());
  stencils.hessian.resize(stencils.offset.back(), 3);
  stencils.gradient.resize(static_cast<int>(each.size()), 6);
  for (int t = 0; t < static_cast<int>(each.size()); ++t) {
    stencils.vertex.insert(stencils.vertex.end(), each[t].vertex.begin(), each[t].vertex.end());
    stencils.hessian.middleRows(stencils.offset[t], each[t].weight.cols()) = each[t].weight.transpose();
    set_gradient(field, t, stencils);
  }
  return stencils;
}

}  // namespace

double stencil_magnitude(const HeightField& field, const HessianStencil& stencil) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector2 p = field.xy.row(stencil.vertex[i]);
    for (size_t k = 0; k < stencil.vertex.size(); ++k) {
      // Opposite vertex 3 + i does not share an edge with corner i.
      if (k == static_cast<size_t>(3 + i)) continue;
      longest = std::max(longest, (field.xy.row(stencil.vertex[k]).transpose() - p).squaredNorm());
    }
  }
  return stencil.weight.cwiseAbs().maxCoeff() * longest;
}

Stencils make_stencils(const HeightField& field, StencilKind kind) {
  std::vector<HessianStencil> each(field.triangle_count());
  std::vector<char> fell_back(field.triangle_count(), 0);
#pragma omp parallel for schedule(static)
  for (int t = 0; t < field.triangle_count(); ++t) {
    bool used_other = false;
    each[t] = with_fallback(field, t, kind, used_other);
    fell_back[t] = used_other;
  }
  const auto missing = std::count_if(each.begin(), each.end(), [](const HessianStencil& s) { return s.empty(); });
  if (missing > 0) {
    throw InvalidInput(
        "The quadratic stencil is not defined on " + std::to_string(missing) + " of " + std::to_string(each.size()) +
        " triangles (a border, valence three, or six points on a conic); choose the consistent stencil.");
  }
  Stencils stencils = pack(field, each);
  stencils.fallback_count = static_cast<int>(std::count(fell_back.begin(), fell_back.end(), 1));
  return stencils;
}

}  // namespace reflines

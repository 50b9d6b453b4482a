#include "geometry/stencil.h"

#include <algorithm>

#include "base/parallel_failure.h"
#include "geometry/stencil_quality.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

// The paper's constant C: a six-point stencil with a larger coefficient times l_max^2 counts as unstable.
constexpr double kPaperThreshold = 5.0;
// The affine_magnitude above which kConsistent takes the ring: sane six points have 0.9 to 3.7 on meshes of any aspect,
// and every ring costs fill. The paper's measure grows with the aspect.
constexpr double kMostMagnitude = 5.0;

// The cubic_error above which kConsistent takes the ring: irregular meshes of compact triangles have less.
constexpr double kMostCubicError = 0.8;

bool is_good(const HeightField& field, int t, const HessianStencil& six, StencilKind kind) {
  if (kind == StencilKind::kHybrid) return stencil_magnitude(field, six) <= kPaperThreshold;
  return affine_magnitude(field, six) <= kMostMagnitude && cubic_error(field, t, six) <= kMostCubicError;
}

HessianStencil compute_with_fallback(const HeightField& field, int t, StencilKind kind, bool& fell_back) {
  if (kind == StencilKind::kAveraged) return averaged_hessian(field, t);
  HessianStencil six = quadratic_hessian(field, t);
  if (kind == StencilKind::kQuadratic) {
    fell_back = six.empty() && field.neighbors.row(t).minCoeff() < 0;
    return fell_back ? averaged_hessian(field, t) : six;
  }
  if (!six.empty() && is_good(field, t, six, kind)) return six;
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

// The stencils of a range of neighbouring triangles in consecutive memory. A million separate ones would take more
// memory for the heap's book-keeping than for the weights.
struct Chunk {
  std::vector<int> size;       // entries of each triangle; 0 where it has no stencil
  std::vector<int> vertex;     // #entries
  std::vector<double> weight;  // #entries x 3
  int fallback_count = 0;

  void add(const HessianStencil& stencil) {
    size.push_back(static_cast<int>(stencil.vertex.size()));
    vertex.insert(vertex.end(), stencil.vertex.begin(), stencil.vertex.end());
    weight.insert(weight.end(), stencil.weight.data(), stencil.weight.data() + 3 * stencil.vertex.size());
  }
};

constexpr int kChunkSize = 4096;

std::vector<Chunk> make_chunks(const HeightField& field, StencilKind kind) {
  std::vector<Chunk> chunks((field.triangle_count() + kChunkSize - 1) / kChunkSize);
  run_parallel(static_cast<int>(chunks.size()), 1, [&](int c) {
    const int end = std::min((c + 1) * kChunkSize, field.triangle_count());
    for (int t = c * kChunkSize; t < end; ++t) {
      bool fell_back = false;
      chunks[c].add(compute_with_fallback(field, t, kind, fell_back));
      chunks[c].fallback_count += fell_back;
    }
  });
  return chunks;
}

void check_defined(const std::vector<Chunk>& chunks, int triangle_count) {
  int missing = 0;
  for (const Chunk& chunk : chunks) missing += static_cast<int>(std::count(chunk.size.begin(), chunk.size.end(), 0));
  if (missing == 0) return;
  throw InvalidInput("The quadratic stencil is not defined on " + std::to_string(missing) + " of " +
                     std::to_string(triangle_count) +
                     " triangles (valence three, or six points on a conic); choose the consistent stencil.");
}

Stencils pack(const HeightField& field, std::vector<Chunk> chunks) {
  Stencils stencils;
  stencils.offset.reserve(field.triangle_count() + 1);
  stencils.offset.push_back(0);
  for (const Chunk& chunk : chunks) {
    for (int size : chunk.size) stencils.offset.push_back(stencils.offset.back() + size);
    stencils.fallback_count += chunk.fallback_count;
  }
  stencils.vertex.reserve(stencils.offset.back());
  stencils.hessian.resize(stencils.offset.back(), 3);
  double* weight = stencils.hessian.data();
  for (Chunk& chunk : chunks) {
    stencils.vertex.insert(stencils.vertex.end(), chunk.vertex.begin(), chunk.vertex.end());
    weight = std::copy(chunk.weight.begin(), chunk.weight.end(), weight);
    chunk = {};
  }
  stencils.gradient.resize(field.triangle_count(), 6);
  for (int t = 0; t < field.triangle_count(); ++t) set_gradient(field, t, stencils);
  return stencils;
}

}  // namespace

Mask held_at_border(const HeightField& field) {
  Mask result(field.triangle_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    result(t) = field.neighbors.row(t).minCoeff() < 0 && !field.has_free_vertex(t);
    for (int i = 0; i < 3 && result(t); ++i) {
      if (field.neighbors(t, i) >= 0) result(t) = !field.has_free_vertex(field.neighbors(t, i));
    }
  }
  return result;
}

Stencils make_stencils(const HeightField& field, StencilKind kind) {
  std::vector<Chunk> chunks = make_chunks(field, kind);
  check_defined(chunks, field.triangle_count());
  return pack(field, std::move(chunks));
}

Stencils select_stencils(const Stencils& all, const std::vector<int>& triangles) {
  Stencils chosen;
  chosen.offset.push_back(0);
  for (const int t : triangles) {
    for (int e = all.offset[t]; e < all.offset[t + 1]; ++e) chosen.vertex.push_back(all.vertex[e]);
    chosen.offset.push_back(static_cast<int>(chosen.vertex.size()));
  }
  chosen.hessian.resize(static_cast<Eigen::Index>(chosen.vertex.size()), 3);
  chosen.gradient.resize(static_cast<Eigen::Index>(triangles.size()), 6);
  for (size_t k = 0; k < triangles.size(); ++k) {
    const int first = all.offset[triangles[k]], size = all.offset[triangles[k] + 1] - first;
    chosen.hessian.middleRows(chosen.offset[k], size) = all.hessian.middleRows(first, size);
    chosen.gradient.row(static_cast<int>(k)) = all.gradient.row(triangles[k]);
  }
  return chosen;
}

}  // namespace reflines

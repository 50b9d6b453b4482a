#include "geometry/stencil.h"

#include <algorithm>

#include "reflines/errors.h"

namespace reflines {
namespace {

// The paper's constant C: a six-point stencil with a larger coefficient times l_max^2 counts as unstable.
constexpr double kPaperThreshold = 5.0;
// The constant C of kConsistent. Recovering the sphere of Figure 5 on irregular meshes of 64 | 128 cells a side, the
// error in 1e-6 of the depth is 20 | 3.8, 11 | 3.7, 9.2 | 2.8, 9.5 | 2.8, 10 | 2.7, 10 | 2.8, 10 | 2.8 for C = 5, 7,
// 10, 14, 20, 50, 1000; regular, 4-8 and valence three meshes give the same for all of them. Accuracy does not need the
// ring on sane stencils, and every ring costs fill. 20 leaves it to borders, valence three and points close to a conic.
constexpr double kConsistentThreshold = 20.0;

HessianStencil compute_with_fallback(const HeightField& field, int t, StencilKind kind, bool& fell_back) {
  if (kind == StencilKind::kAveraged) return averaged_hessian(field, t);
  HessianStencil six = quadratic_hessian(field, t);
  if (kind == StencilKind::kQuadratic) {
    fell_back = six.empty() && field.neighbors.row(t).minCoeff() < 0;
    return fell_back ? averaged_hessian(field, t) : six;
  }
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
#pragma omp parallel for schedule(dynamic) if (field.triangle_count() > kWorthThreads)
  for (int c = 0; c < static_cast<int>(chunks.size()); ++c) {
    const int end = std::min((c + 1) * kChunkSize, field.triangle_count());
    for (int t = c * kChunkSize; t < end; ++t) {
      bool fell_back = false;
      chunks[c].add(compute_with_fallback(field, t, kind, fell_back));
      chunks[c].fallback_count += fell_back;
    }
  }
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
  const auto any_free = [&field](int t) {
    bool free = false;
    for (int i = 0; i < 3; ++i) free = free || field.role[field.F(t, i)] == VertexRole::kFree;
    return free;
  };
  Mask result(field.triangle_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    result(t) = field.neighbors.row(t).minCoeff() < 0 && !any_free(t);
    for (int i = 0; i < 3 && result(t); ++i) {
      if (field.neighbors(t, i) >= 0) result(t) = !any_free(field.neighbors(t, i));
    }
  }
  return result;
}

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

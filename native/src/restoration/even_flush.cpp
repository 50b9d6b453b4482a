#include "restoration/even_flush.h"

#include "geometry/next_edges.h"

namespace reflines {
namespace {

// Returns the edge that goes on from each edge of a rim without a corner, or -1.
std::vector<int> find_next(const Positions& V, const Triangles& rim, const IndexVector& across) {
  const auto faces = [&](int k) { return across(rim(k, 0)) >= 0 && across(rim(k, 0)) == across(rim(k, 1)); };
  return find_next_edges(V, rim.leftCols<2>(), [&](int k, int follower) { return faces(k) && faces(follower); });
}

// Follows the edges from one on, and marks them as used.
RimRun follow(const Triangles& rim, const std::vector<int>& next, int first, std::vector<bool>& used) {
  RimRun run;
  int k = first;
  for (; k >= 0 && !used[k]; k = next[k]) {
    used[k] = true;
    run.vertices.push_back(rim(k, 0));
    if (next[k] < 0) run.vertices.push_back(rim(k, 1));
  }
  run.closed = k == first;
  return run;
}

// Returns the way along a run to each of its vertices, and last that around a closed one.
Vector measure_way(const Positions& V, const RimRun& run) {
  const size_t count = run.vertices.size();
  Vector way = Vector::Zero(static_cast<Eigen::Index>(count + 1));
  for (size_t k = 0; k < count; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    way(row + 1) = way(row) + (V.row(run.vertices[(k + 1) % count]) - V.row(run.vertices[k])).norm();
  }
  return way;
}

}  // namespace

std::vector<RimRun> find_rim_runs(const Positions& V, const Triangles& rim, const IndexVector& across) {
  const std::vector<int> next = find_next(V, rim, across);
  std::vector<bool> used(rim.rows(), false), follows(rim.rows(), false);
  for (const int k : next) {
    if (k >= 0) follows[k] = true;
  }
  std::vector<RimRun> runs;
  for (const bool closed : {false, true}) {
    for (int k = 0; k < rim.rows(); ++k) {
      if (!used[k] && next[k] >= 0 && follows[k] == closed) runs.push_back(follow(rim, next, k, used));
    }
  }
  return runs;
}

Vector find_uneven_flush(const Positions& V, const RimRun& run, const Vector& flush) {
  const Vector way = measure_way(V, run), own = flush(run.vertices);
  const Eigen::Index count = own.size();
  if (run.closed) {
    double sum = 0;
    for (Eigen::Index k = 0; k < count; ++k) sum += 0.5 * (own(k) + own((k + 1) % count)) * (way(k + 1) - way(k));
    return own.array() - sum / way(count);
  }
  return own - own(0) * Vector::Ones(count) - (own(count - 1) - own(0)) / way(count - 1) * way.head(count);
}

}  // namespace reflines

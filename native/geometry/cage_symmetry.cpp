#include "native/geometry/cage_symmetry.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "native/errors.h"

namespace reflines {
namespace {

// The first vertex without a partner within the tolerance of a place, nearest first; -1 where there is none.
int nearest(const Positions& V, const std::vector<int>& by_x, const IndexVector& partner, const Vector3& place,
            double tolerance) {
  const auto left = [&](int vertex, double x) { return V(vertex, 0) < x; };
  int best = -1;
  double best_distance = tolerance;
  for (auto it = std::lower_bound(by_x.begin(), by_x.end(), place.x() - tolerance, left); it != by_x.end(); ++it) {
    if (V(*it, 0) > place.x() + tolerance) break;
    const double distance = (V.row(*it).transpose() - place).norm();
    const bool closer = distance < best_distance || (distance == best_distance && (best < 0 || *it < best));
    if (partner[*it] >= 0 || !closer) continue;
    best = *it;
    best_distance = distance;
  }
  return best;
}

}  // namespace

IndexVector mirror_pairs(const Positions& V, const MirrorPlane& plane, double tolerance) {
  if (plane.normal.norm() == 0) throw InvalidInput("The mirror plane's normal has length 0: give its direction.");
  const Vector3 normal = plane.normal.normalized();
  const Vector side = (V.rowwise() - plane.point.transpose()) * normal;
  std::vector<int> by_x(V.rows());
  std::iota(by_x.begin(), by_x.end(), 0);
  std::stable_sort(by_x.begin(), by_x.end(), [&](int a, int b) { return V(a, 0) < V(b, 0); });
  IndexVector partner = IndexVector::Constant(V.rows(), -1);
  for (int v = 0; v < V.rows(); ++v) {
    if (std::abs(side[v]) <= tolerance / 2) partner[v] = v;  // its image is within the tolerance of itself
  }
  for (int v = 0; v < V.rows(); ++v) {
    if (partner[v] >= 0) continue;
    const Vector3 image = V.row(v).transpose() - 2 * side[v] * normal;
    const int other = nearest(V, by_x, partner, image, tolerance);
    if (other < 0 || other == v) continue;
    partner[v] = other;
    partner[other] = v;
  }
  return partner;
}

SparseMatrix cage_unknowns(const Mask& held, const IndexVector& partner) {
  std::vector<Eigen::Triplet<double>> entries;
  int unknowns = 0;
  for (int v = 0; v < held.size(); ++v) {
    const int other = partner.size() > 0 && partner[v] >= 0 ? partner[v] : v;
    if (other < v || held[v] || held[other]) continue;
    entries.emplace_back(v, unknowns, 1.0);
    if (other != v) entries.emplace_back(other, unknowns, 1.0);
    ++unknowns;
  }
  SparseMatrix B(held.size(), unknowns);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

}  // namespace reflines

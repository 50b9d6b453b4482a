#include "geometry/cage_symmetry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "reflines/errors.h"

namespace reflines {
namespace {

using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

constexpr double kSameMark = 1e-12;  // tolerance of sums that differ by rounding; the marks of 1e5 rows lie 1e-5 apart
constexpr double kNoMark = 1e3;

// Returns a pseudo-random number between 0 and 1 for an index.
double hash_index(int index) {
  const double x = 43758.5453 * std::sin(12.9898 * (index + 1));
  return x - std::floor(x);
}

// The vertices in the order of their place along a direction in which few rows of a grid lie at one place: sorted by x,
// each search among 100,000 vertices of a grid looked at a whole column.
struct SortedVertices {
  explicit SortedVertices(const Positions& vertices) : V(vertices), place(V * kAlong), order(V.rows()) {
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return place(a) < place(b); });
  }

  static inline const Vector3 kAlong = Vector3(0.8, 0.49, 0.35).normalized();
  const Positions& V;
  Vector place;            // #V
  std::vector<int> order;  // #V
};

// Returns the nearest vertex without a partner within the tolerance of a point, the first of equally near ones; -1
// where there is none.
int find_nearest(const SortedVertices& sorted, const IndexVector& partner, const Vector3& point, double tolerance) {
  const double middle = point.dot(SortedVertices::kAlong);
  const double radius = tolerance + 1e-14 * (point.lpNorm<1>() + tolerance);  // more than the rounding of the products
  const auto before = [&](int vertex, double x) { return sorted.place(vertex) < x; };
  int best = -1;
  double best_distance = tolerance;
  for (auto it = std::lower_bound(sorted.order.begin(), sorted.order.end(), middle - radius, before);
       it != sorted.order.end(); ++it) {
    if (sorted.place(*it) > middle + radius) break;
    const double distance = (sorted.V.row(*it).transpose() - point).norm();
    const bool closer = distance < best_distance || (distance == best_distance && (best < 0 || *it < best));
    if (partner[*it] >= 0 || !closer) continue;
    best = *it;
    best_distance = distance;
  }
  return best;
}

void check(const MirrorPlane& plane, double tolerance) {
  if (plane.normal.isZero(0)) throw InvalidInput("The mirror plane's normal has length 0: give its direction.");
  if (!plane.normal.allFinite() || !plane.point.allFinite()) {
    throw InvalidInput("The mirror plane has a coordinate that is not a finite number: give its point and normal.");
  }
  if (!(tolerance >= 0)) throw InvalidInput("The tolerance of mirror images must be 0 or a positive length.");
}

}  // namespace

IndexVector mirror_pairs(const Positions& V, const MirrorPlane& plane, double tolerance) {
  check(plane, tolerance);
  const Vector3 normal = plane.normal.stableNormalized();
  const Vector side = (V.rowwise() - plane.point.transpose()) * normal;
  const SortedVertices sorted(V);
  IndexVector partner = IndexVector::Constant(V.rows(), -1);
  for (int v = 0; v < V.rows(); ++v) {
    if (std::abs(side[v]) <= tolerance / 2) partner[v] = v;  // its image is within the tolerance of itself
  }
  for (int v = 0; v < V.rows(); ++v) {
    if (partner[v] >= 0) continue;
    const Vector3 image = V.row(v).transpose() - 2 * side[v] * normal;
    const int other = find_nearest(sorted, partner, image, tolerance);
    if (other < 0 || other == v) continue;
    partner[v] = other;
    partner[other] = v;
  }
  return partner;
}

SparseMatrix build_cage_unknowns(const Mask& held, const IndexVector& partner) {
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

IndexVector find_refined_partners(const SparseMatrix& S, const IndexVector& partner) {
  Positions marks(S.cols(), 3), image = Positions::Constant(S.cols(), 3, kNoMark);
  for (int v = 0; v < S.cols(); ++v) marks.row(v) << hash_index(3 * v), hash_index(3 * v + 1), hash_index(3 * v + 2);
  for (int v = 0; v < S.cols(); ++v) {
    if (partner[v] >= 0) image.row(v) = marks.row(partner[v]);
  }
  const Positions own = S * marks, other = S * image;
  std::vector<int> by_first(own.rows());
  std::iota(by_first.begin(), by_first.end(), 0);
  std::stable_sort(by_first.begin(), by_first.end(), [&](int a, int b) { return own(a, 0) < own(b, 0); });
  const auto left = [&](int row, double x) { return own(row, 0) < x; };
  IndexVector result = IndexVector::Constant(own.rows(), -1);
  for (int row = 0; row < own.rows(); ++row) {
    const double low = other(row, 0) - kSameMark;
    for (auto it = std::lower_bound(by_first.begin(), by_first.end(), low, left); it != by_first.end(); ++it) {
      if (own(*it, 0) > low + 2 * kSameMark) break;
      if ((own.row(*it) - other.row(row)).cwiseAbs().maxCoeff() < kSameMark) result[row] = *it;
    }
  }
  return result;
}

SparseMatrix symmetrize(const SparseMatrix& S, const IndexVector& partner, const IndexVector& refined_partner) {
  const RowMatrix rows = S;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(S.nonZeros());
  for (int row = 0; row < rows.rows(); ++row) {
    const int other = refined_partner[row], source = other >= 0 && other < row ? other : row;
    for (RowMatrix::InnerIterator it(rows, source); it; ++it) {
      const int column = static_cast<int>(it.col());
      const double weight = other == row ? 0.5 * (it.value() + rows.coeff(row, partner[column])) : it.value();
      entries.emplace_back(row, source == row ? column : partner[column], weight);
    }
  }
  SparseMatrix result(S.rows(), S.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Positions multiply_symmetric(const SparseMatrix& S, const IndexVector& partner, const IndexVector& refined_partner,
                             const Positions& V) {
  const RowMatrix rows = S;
  Positions result = Positions::Zero(S.rows(), 3);
  for (int row = 0; row < rows.rows(); ++row) {
    const int other = refined_partner[row], source = other >= 0 && other < row ? other : row;
    for (RowMatrix::InnerIterator it(rows, source); it; ++it) {
      const int column = static_cast<int>(it.col()), image = other >= 0 ? partner[column] : column;
      if (other == row && image < column)
        continue;  // added together with its partner: the components normal to the plane cancel
      if (other == row && image != column) {
        result.row(row) += it.value() * (V.row(column) + V.row(image));
      } else {
        result.row(row) += it.value() * V.row(source == row ? column : image);
      }
    }
  }
  return result;
}

}  // namespace reflines

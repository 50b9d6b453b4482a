#include "solver/region_pieces.h"

#include <limits>

#include "geometry/centroids.h"
#include "reflection/strong_features.h"

namespace reflines {
namespace {

// The error of a move that is measured between two positions, in roundings of the largest coordinate: each coordinate
// is rounded once, of a cage's vertices as of its surface's.
constexpr double kPositionRoundings = 16.0;

}  // namespace

RegionPieces::RegionPieces(const Positions& V, const Triangles& F, const ImagePlane& frame)
    : frame_(frame), V_(V), F_(F) {}

PlanePositions RegionPieces::xy() const { return frame_.project(V_); }

PlanePositions RegionPieces::centers() const { return find_centroids(xy(), F_); }

// Returns the rows of all triangles, zeros for those in no piece: of the others read(piece).
template <typename Rows, typename Read>
Rows RegionPieces::gather(int columns, const Read& read) const {
  Rows result = Rows::Zero(triangle_count(), columns);
  for (const auto& piece : pieces_) result(piece->triangles(), Eigen::all) = read(*piece);
  return result;
}

Vector RegionPieces::area() const {
  return gather<Vector>(1, [](const PieceProblem& piece) { return piece.field().area; });
}

Mask RegionPieces::active() const {
  return gather<Mask>(1, [](const PieceProblem& piece) { return Mask::Constant(piece.triangles().size(), true); });
}

Mask RegionPieces::changeable() const {
  return gather<Mask>(1, [](const PieceProblem& piece) { return piece.changeable(); });
}

Mask RegionPieces::hidden() const {
  return gather<Mask>(1, [](const PieceProblem& piece) { return piece.hidden(); });
}

Mask RegionPieces::free() const {
  Mask result = Mask::Constant(vertex_count(), false);
  for (const auto& piece : pieces_) {
    const std::vector<int>& vertex = piece->vertices();
    for (size_t v = 0; v < vertex.size(); ++v) {
      if (piece->field().role[v] == VertexRole::kFree) result(vertex[v]) = true;
    }
  }
  return result;
}

void RegionPieces::set_limit(const MoveLimit& limit) {
  const double rounding = kPositionRoundings * std::numeric_limits<double>::epsilon() * V_.cwiseAbs().maxCoeff();
  for (const auto& piece : pieces_) piece->set_limit(limit, rounding);
  limit_ = limit;
}

MoveRange RegionPieces::range(int vertex) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!limit_.exists()) return {-kInfinity, kInfinity};
  return {limit_.lowest(vertex), limit_.highest(vertex)};
}

IndexVector RegionPieces::at_limit() const {
  IndexVector result = IndexVector::Zero(vertex_count());
  for (const auto& piece : pieces_) {
    for (int v = 0; v < piece->field().vertex_count(); ++v) {
      if (piece->field().role[v] == VertexRole::kFree) result(piece->vertices()[v]) = piece->limited(v);
    }
  }
  return result;
}

Vector RegionPieces::heights() const {
  Vector result = frame_.heights(V_);
  for (const auto& piece : pieces_) {
    for (int v = 0; v < piece->field().vertex_count(); ++v) {
      const int vertex = piece->vertices()[v];
      result(vertex) = move_height(result(vertex), piece->move(v), range(vertex));
    }
  }
  return result;
}

Positions RegionPieces::positions() const {
  Positions result = V_;
  for (const auto& piece : pieces_) {
    for (int v = 0; v < piece->field().vertex_count(); ++v) {
      const int vertex = piece->vertices()[v];
      const double move = piece->move(v);
      if (piece->field().role[v] != VertexRole::kFree || move == 0) continue;
      result.row(vertex) = move_point(V_.row(vertex), move, frame_.z(), range(vertex));
    }
  }
  return result;
}

Vector RegionPieces::theta(int family) const {
  return gather<Vector>(1, [&](PieceProblem& piece) { return piece.lines(family).theta; });
}

PlaneVectors RegionPieces::field(int family) const {
  return gather<PlaneVectors>(2, [&](PieceProblem& piece) { return piece.lines(family).gradient; });
}

PlaneVectors RegionPieces::smooth_field(const SmoothOptions& options, int family) {
  return gather<PlaneVectors>(2, [&](PieceProblem& piece) {
    const PlaneVectors own = piece.lines(family).gradient;
    return piece.size() > 0 ? piece.smoother().smooth(own, options, family) : own;
  });
}

Mask RegionPieces::features(int family, double length) {
  return gather<Mask>(1, [&](PieceProblem& piece) { return piece.smoother().features(length, family); });
}

PlaneVectors RegionPieces::start_field(int family) const {
  return gather<PlaneVectors>(2, [&](const PieceProblem& piece) { return piece.smoother().start_gradient(family); });
}

double RegionPieces::strong_size(const PlaneVectors& field) const {
  const PlanePositions center = centers();  // not the vertices: those of no triangle may lie anywhere
  const double diagonal = (center.colwise().maxCoeff() - center.colwise().minCoeff()).norm();
  return find_strong_size(field, area(), diagonal);
}

Vector RegionPieces::response(int family, const Mask& features) const {
  const PlaneVectors start = start_field(family);
  return features.select(0.0, measure_response(start, strong_size(start)).array());
}

RegionField RegionPieces::region_field(int family, double feature_length) {
  const Mask feature = features(family, feature_length);
  RegionField result{xy(),
                     F_,
                     Eigen::VectorXi::Constant(triangle_count(), -1),
                     feature,
                     response(family, feature),
                     area(),
                     centers(),
                     theta(family),
                     field(family),
                     Vector::Zero(vertex_count()),
                     PlaneVectors::Zero(vertex_count(), 2),
                     PlaneVectors::Zero(vertex_count(), 2),
                     family};
  int first = 0;  // number of the problem's first piece: those of mirror images are one problem
  for (const auto& piece : pieces_) {
    piece->add_vertex_field(result);
    const HeightField& field = piece->field();
    for (int t = 0; t < field.triangle_count(); ++t) result.piece(field.source[t]) = first + field.piece[t];
    first += field.piece_count;
  }
  return result;
}

const PieceProblem& RegionPieces::piece_of(int number) const {
  size_t k = 0;
  for (int last = pieces_[0]->field().piece_count; last <= number; last += pieces_[k]->field().piece_count) ++k;
  return *pieces_[k];
}

RegionField RegionPieces::vertex_field(int family) const {
  RegionField result;
  result.xy = xy();
  result.F = F_;
  result.vertex_theta = Vector::Zero(vertex_count());
  result.vertex_gradient = PlaneVectors::Zero(vertex_count(), 2);
  result.vertex_slope = PlaneVectors::Zero(vertex_count(), 2);
  result.family = family;
  for (const auto& piece : pieces_) piece->add_vertex_field(result);
  return result;
}

void RegionPieces::read_lines(const Vector& heights, const Vector& weight, Target& target, Vector& theta) const {
  const Vector now = this->heights();
  for (const auto& piece : pieces_) {
    const std::vector<int>& vertex = piece->vertices();
    const Vector known = weight(vertex);
    const Vector z = (known.array() > 0).select(piece->heights() + heights(vertex) - now(vertex), piece->heights());
    const ReflectionField own = piece->evaluate_lines(z, target.family);
    for (int t = 0; t < own.theta.size(); ++t) {
      const int row = piece->triangles()[t];
      if (!piece->depends_only_on(t, known)) continue;
      target.weight(row) = 1;
      target.gradient.row(row) = own.gradient.row(t);
      theta(row) = own.theta(t);
    }
  }
}

void RegionPieces::stay_near(const Vector& heights) {
  const Vector rise = heights - this->heights();
  for (const auto& piece : pieces_) piece->stay_near(piece->heights() + rise(piece->vertices()));
}

void RegionPieces::pull_to(const Vector& heights, const Vector& weight) {
  PieceProblem& piece = *pieces_.front();
  const std::vector<int>& vertex = piece.vertices();
  const Vector now = this->heights();
  Vector z = piece.heights(), w = Vector::Zero(z.size());
  for (int v = 0; v < z.size(); ++v) {
    if (weight(vertex[v]) == 0) continue;
    z(v) += heights(vertex[v]) - now(vertex[v]);
    w(v) = weight(vertex[v]);
  }
  piece.pull_to(z, w);
}

}  // namespace reflines

#include "native/cage_optimizer.h"

#include <string>

#include "native/errors.h"
#include "native/geometry/cage_symmetry.h"
#include "native/optimization/linear_solver.h"

namespace reflines {
namespace {

// Relative to the largest diagonal entry: holds vertices of the cage that no fitted height sees.
constexpr double kUnseen = 1e-9;

void check_length(Eigen::Index length, Eigen::Index wanted, const std::string& what) {
  if (length == 0 || length == wanted) return;
  throw InvalidInput("The " + what + " has " + std::to_string(length) + " entries; the cage needs " +
                     std::to_string(wanted) + ".");
}

void check_lengths(const Cage& cage, const Positions& V, const CageOptions& options) {
  if (V.rows() != cage.vertices) {
    throw InvalidInput("There are " + std::to_string(V.rows()) + " positions for the " + std::to_string(cage.vertices) +
                       " vertices of the cage; give one for each.");
  }
  check_length(options.region.size(), cage.face_offsets.size() - 1, "region mask");
  check_length(options.held.size(), cage.vertices, "held mask");
  check_length(options.partner.size(), cage.vertices, "list of mirror partners");
}

// Numbers 0 .. of the refined vertices in faces of the region, or -1; fills `refined` with the way back. In the order
// of the faces, whose neighbours in the list are neighbours on the surface: the energy then finds its heights close
// together.
std::vector<int> number_vertices(const Subdivision& whole, const Mask& region, IndexVector& refined) {
  std::vector<int> number(whole.positions.rows(), -1);
  refined.resize(whole.positions.rows());
  int count = 0;
  for (int f = 0; f < whole.faces.rows(); ++f) {
    if (!region(whole.face_parent(f))) continue;
    for (const int v : whole.faces.row(f)) {
      if (number[v] >= 0) continue;
      refined(count) = v;
      number[v] = count++;
    }
  }
  refined.conservativeResize(count);
  return number;
}

SparseMatrix chosen_rows(const SparseMatrix& matrix, const std::vector<int>& number, int count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < matrix.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
      if (number[it.row()] >= 0) entries.emplace_back(number[it.row()], j, it.value());
    }
  }
  SparseMatrix result(count, matrix.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

// Quads are cut from their first corner, which subdivision turns alike all over a face of the cage.
void cut_faces(const Subdivision& whole, const Mask& region, const std::vector<int>& number, Triangles& F,
               IndexVector& parent) {
  const int pieces = static_cast<int>(whole.faces.cols()) - 2;
  F.resize(pieces * whole.faces.rows(), 3);
  parent.resize(F.rows());
  int count = 0;
  for (int f = 0; f < whole.faces.rows(); ++f) {
    if (!region(whole.face_parent(f))) continue;
    for (int k = 0; k < pieces; ++k, ++count) {
      F.row(count) << number[whole.faces(f, 0)], number[whole.faces(f, k + 1)], number[whole.faces(f, k + 2)];
      parent(count) = whole.face_parent(f);
    }
  }
  F.conservativeResize(count, 3);
  parent.conservativeResize(count);
}

ShapeOptions shape_options(const SparseMatrix& B, const Vector& start, ShapeOptions shape) {
  shape.border.assign(B.rows(), Border::kFree);
  shape.held.resize(0);
  shape.motion = {B, start};
  return shape;
}

}  // namespace

CageOptimizer::Surface CageOptimizer::make_surface(const Cage& cage, const Positions& V, const Vector3& view,
                                                   const CageOptions& options) {
  check_lengths(cage, V, options);
  const Subdivision whole = subdivide(cage, options.subdivision);
  const Mask region = options.region.size() > 0 ? options.region : Mask::Constant(cage.face_offsets.size() - 1, true);
  Mask held = held_by_border(whole, region, options.hold);
  if (options.held.size() > 0) held = held || options.held;
  Surface surface;
  const std::vector<int> number = number_vertices(whole, region, surface.refined);
  surface.S = chosen_rows(whole.positions, number, static_cast<int>(surface.refined.size()));
  cut_faces(whole, region, number, surface.F, surface.parent);
  surface.rise = cage_unknowns(held, options.partner);
  const Vector heights = (V.rowwise() - V.colwise().mean()) * view.normalized();
  surface.start.resize(surface.rise.cols());
  for (int k = 0; k < surface.start.size(); ++k) {
    surface.start(k) = heights(SparseMatrix::InnerIterator(surface.rise, k).row());
  }
  return surface;
}

CageOptimizer::CageOptimizer(const Cage& cage, const Positions& V, const Vector3& view_direction,
                             const std::vector<Vector3>& line_directions, const CageOptions& options)
    : CageOptimizer(make_surface(cage, V, view_direction, options), V, view_direction, line_directions, options.shape) {
}

CageOptimizer::CageOptimizer(Surface surface, const Positions& V, const Vector3& view_direction,
                             const std::vector<Vector3>& line_directions, const ShapeOptions& options)
    : ShapeOptimizer(surface.S * V, surface.F, view_direction, line_directions,
                     shape_options(surface.S * surface.rise, surface.start, options)),
      V_(V),
      surface_(std::move(surface)) {
  region_.free = static_cast<int>(cage_free().count());
  region_.fixed = static_cast<int>(V_.rows()) - region_.free;
  region_.clamped = 0;
}

Mask CageOptimizer::cage_free() const {
  Mask result = Mask::Constant(V_.rows(), false);
  for (const int k : moving()) {
    for (SparseMatrix::InnerIterator it(surface_.rise, k); it; ++it) result(it.row()) = true;
  }
  return result;
}

Positions CageOptimizer::cage_positions() const {
  Positions result = V_;
  for (size_t j = 0; j < moving().size(); ++j) {
    const double move = unknowns()(static_cast<int>(j)) - surface_.start(moving()[j]);
    if (move == 0) continue;
    for (SparseMatrix::InnerIterator it(surface_.rise, moving()[j]); it; ++it) {
      result.row(it.row()) += move * frame().z().transpose();
    }
  }
  return result;
}

void CageOptimizer::fit(const Vector& heights, const Vector& weight) {
  const int n = static_cast<int>(moving().size());
  if (heights.size() != surface_.S.rows() || weight.size() != heights.size()) {
    throw InvalidInput("There are " + std::to_string(heights.size()) + " heights and " + std::to_string(weight.size()) +
                       " weights to fit; the surface has " + std::to_string(surface_.S.rows()) + " vertices.");
  }
  const SparseMatrix all = surface_.S * surface_.rise;
  SparseMatrix B(all.rows(), n);
  for (int k = 0; k < n; ++k) B.col(k) = all.col(moving()[k]);
  const SparseMatrix WB = weight.asDiagonal() * B;
  SparseMatrix identity(n, n);
  identity.setIdentity();
  const SparseMatrix normal = B.transpose() * WB;
  const SparseMatrix lower =
      SparseMatrix(normal + kUnseen * normal.diagonal().maxCoeff() * identity).triangularView<Eigen::Lower>();
  Vector step = WB.transpose() * (heights - this->heights());
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(lower);
  solver.factorize(lower);
  solver.solve(step);
  rest_at(unknowns() + step);
}

}  // namespace reflines

#include "geometry/height_field.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "base/union_find.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

enum class Facing { kViewer, kSilhouette, kAway };

Facing facing(const Positions& V, const Triangles& F, int t, const Vector3& view) {
  const double cosine = unit_normal(V, F, t).dot(view);
  if (std::abs(cosine) < kSilhouette) return Facing::kSilhouette;
  return cosine > 0 ? Facing::kViewer : Facing::kAway;
}

// Fills F, source and the masks of the other triangles; returns the vertices of those.
Mask keep_facing(const Positions& V, const Triangles& F, const Vector3& view, HeightField& field) {
  Mask left_out = Mask::Constant(V.rows(), false);
  field.silhouette = field.turned_away = Mask::Constant(F.rows(), false);
  field.F.resize(F.rows(), 3);
  for (int t = 0; t < F.rows(); ++t) {
    const Facing side = facing(V, F, t, view);
    if (side == Facing::kViewer) {
      field.F.row(static_cast<int>(field.source.size())) = F.row(t);
      field.source.push_back(t);
      continue;
    }
    (side == Facing::kAway ? field.turned_away : field.silhouette)(t) = true;
    for (int i = 0; i < 3; ++i) left_out(F(t, i)) = true;
  }
  field.F.conservativeResize(static_cast<int>(field.source.size()), 3);
  return left_out;
}

void project(const Positions& V, const ImagePlane& frame, HeightField& field) {
  Vector3 centroid = Vector3::Zero();
  for (int k = 0; k < field.F.size(); ++k) centroid += V.row(field.F.data()[k]).transpose();
  centroid /= static_cast<double>(field.F.size());
  const Positions centred = V.rowwise() - centroid.transpose();
  field.xy = frame.project(centred);
  field.z = frame.heights(centred);
  field.area.resize(field.F.rows());
  for (int t = 0; t < field.F.rows(); ++t) {
    const Vector2 a = field.xy.row(field.F(t, 0)), b = field.xy.row(field.F(t, 1)), c = field.xy.row(field.F(t, 2));
    field.area(t) = 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
  }
}

// Cuts `neighbors` at the creases and returns their vertices.
Mask cut_creases(const Positions& V, const CreaseOptions& options, HeightField& field) {
  Mask on_crease = Mask::Constant(V.rows(), false);
  const EdgeMask crease = crease_edges(V, field.F, field.neighbors, options);
  field.marked_count = static_cast<int>((crease && marked_edges(field.F, options)).count()) / 2;
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (!crease(t, i)) continue;
      field.crease_count += field.neighbors(t, i) > t;
      on_crease(field.F(t, (i + 1) % 3)) = on_crease(field.F(t, (i + 2) % 3)) = true;
    }
  }
  field.neighbors = crease.select(-1, field.neighbors);
  return on_crease;
}

void hold(std::vector<VertexRole>& role, int v, VertexRole how) {
  if (role[v] == VertexRole::kFree) role[v] = how;
}

// Assigns roles by the vertices of the region's border and of its creases (#V), where the border's condition holds.
void assign_roles(const Triangles& F, const Mask& edge, const Boundary& boundary, const Mask& always_fixed,
                  HeightField& field) {
  field.role.assign(field.vertex_count(), VertexRole::kUnused);
  for (int k = 0; k < field.F.size(); ++k) field.role[field.F.data()[k]] = VertexRole::kFree;
  for (int v = 0; v < field.vertex_count(); ++v) {
    const bool held = boundary.held.size() > 0 && boundary.held(v);
    const bool by_border = edge(v) && boundary.border[v] != Border::kFree;
    if (always_fixed(v) || held || by_border) hold(field.role, v, VertexRole::kFixed);
  }
  const auto clamps = [&](int v) { return edge(v) && keeps_tangents(boundary.border[v]); };
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (!clamps(F(t, i))) continue;
      hold(field.role, F(t, (i + 1) % 3), VertexRole::kClamped);
      hold(field.role, F(t, (i + 2) % 3), VertexRole::kClamped);
    }
  }
}

void find_pieces(const Mask& separating, HeightField& field) {
  UnionFind coupled(field.triangle_count());
  const Incidence& around = field.triangles_of_vertex;
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (field.neighbors(t, i) >= 0) coupled.unite(t, field.neighbors(t, i));
    }
  }
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (separating(v)) continue;
    for (int k = around.begin(v) + 1; k < around.end(v); ++k) coupled.unite(around.items[k - 1], around.items[k]);
  }
  std::vector<int> number(field.triangle_count(), -1);
  field.piece.resize(field.triangle_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    int& name = number[coupled.find(t)];
    if (name < 0) name = field.piece_count++;
    field.piece[t] = name;
  }
}

}  // namespace

bool HeightField::has_free_vertex(int t) const {
  bool result = false;
  for (int i = 0; i < 3; ++i) result = result || role[F(t, i)] == VertexRole::kFree;
  return result;
}

double HeightField::diagonal() const {
  Eigen::AlignedBox2d box;
  for (const int v : F.reshaped()) box.extend(xy.row(v).transpose());
  return box.diagonal().norm();
}

Vector HeightField::piece_diagonals() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PlanePositions low = PlanePositions::Constant(piece_count, 2, kInfinity), high = -low;
  for (int t = 0; t < triangle_count(); ++t) {
    for (const int v : F.row(t)) {
      low.row(piece[t]) = low.row(piece[t]).cwiseMin(xy.row(v));
      high.row(piece[t]) = high.row(piece[t]).cwiseMax(xy.row(v));
    }
  }
  return (high - low).rowwise().norm();
}

HeightField make_height_field(const Positions& V, const Triangles& F, const ImagePlane& frame,
                              const Boundary& boundary) {
  HeightField field;
  const Mask left_out = keep_facing(V, F, frame.z(), field);
  if (field.F.rows() == 0) {
    throw InvalidInput(
        "All faces of the region turn away from the view or are seen edge on: turn the view towards the panel's "
        "outside.");
  }
  const Triangles neighbors = edge_neighbors(F);
  field.closed = neighbors.minCoeff() >= 0;
  project(V, frame, field);
  field.neighbors = field.F.rows() == F.rows() ? neighbors : edge_neighbors(field.F);
  field.triangles_of_vertex = vertex_triangles(field.F, field.vertex_count());
  Mask held = left_out;
  const Mask on_crease = cut_creases(V, boundary.creases, field);
  if (boundary.hold_creases) held = held || on_crease;
  Mask edge = on_crease;
  const Triangles border = find_border_edges(F, neighbors);
  for (const int v : border.reshaped()) edge(v) = true;
  assign_roles(F, edge, boundary, held, field);
  find_pieces(held, field);
  return field;
}

}  // namespace reflines

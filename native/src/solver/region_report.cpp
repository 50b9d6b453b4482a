#include "solver/region_report.h"

#include <algorithm>
#include <vector>

#include "base/sort_unique.h"

namespace reflines {
namespace {

std::string format_face_count(int count) { return std::to_string(count) + (count == 1 ? " face" : " faces"); }

// Adds a note on so many, where there are any.
void tell(NoteKind kind, int count, Region& region) {
  if (count > 0) region.notes.push_back({kind, count});
}

int count(const HeightField& field, VertexRole role) {
  return static_cast<int>(std::count(field.role.begin(), field.role.end(), role));
}

}  // namespace

int count_faces(const Mask& triangles, const IndexVector& face_of_triangle) {
  if (face_of_triangle.size() == 0) return static_cast<int>(triangles.count());
  std::vector<int> faces;
  for (Eigen::Index t = 0; t < triangles.size(); ++t) {
    if (triangles(t)) faces.push_back(face_of_triangle(t));
  }
  sort_unique(faces);
  return static_cast<int>(faces.size());
}

Region describe_region(const HeightField& field, const IndexVector& face_of_triangle, bool creases_held) {
  Region region;
  region.triangles = field.triangle_count();
  region.pieces = field.piece_count;
  region.silhouettes = count_faces(field.silhouette, face_of_triangle);
  region.turned_away = count_faces(field.turned_away, face_of_triangle);
  region.creases = field.crease_count;
  region.marked_creases = field.marked_count;
  region.closed = field.closed;
  region.free = count(field, VertexRole::kFree);
  region.fixed = count(field, VertexRole::kFixed);
  region.clamped = count(field, VertexRole::kClamped);
  tell(NoteKind::kTurnedAway, region.turned_away, region);
  const int sharp = region.creases - region.marked_creases;
  tell(creases_held ? NoteKind::kSharpEdges : NoteKind::kSharpEdgesKept, sharp, region);
  tell(creases_held ? NoteKind::kMarkedEdges : NoteKind::kMarkedEdgesKept, region.marked_creases, region);
  tell(NoteKind::kEdgeOn, region.silhouettes, region);
  return region;
}

std::string explain_no_free_vertex(const Region& region, int faces, int doubled) {
  if (doubled > 0) {
    return "No vertex of the region is free to move: " + format_face_count(faces) + ": " + std::to_string(doubled) +
           (doubled == 1 ? " vertex lies on another" : " vertices lie on others") +
           ", so that faces that touch are not joined; merge them by distance first.";
  }
  const std::string creases = std::to_string(region.creases) + (region.creases == 1 ? " edge" : " edges");
  return "No vertex of the region is free to move (" + format_face_count(faces) + ": all vertices are held by " +
         (region.creases > 0 ? "creases (" + creases + "), " : "") +
         "the border, silhouettes or faces turned away); choose a larger region, or a border that holds less, as a "
         "free one" +
         (region.creases > 0 ? ", or hold fewer creases." : ".");
}

void add_piece_notes(Region& region) {
  tell(NoteKind::kUnusedPieces, region.unused_pieces, region);
  tell(NoteKind::kHiddenFaces, region.hidden, region);
}

void add_eye_notes(const std::vector<Vector>& sight, Region& region) {
  for (size_t k = 0; k < sight.size(); ++k) {
    if (sight[k].isZero(0)) region.notes.push_back({NoteKind::kUnseen, static_cast<int>(k)});
  }
}

void set_feature_count(int count, Region& region) {
  if (count == region.features) return;
  std::erase(region.notes, Note{NoteKind::kFeatures, region.features});
  region.features = count;
  tell(NoteKind::kFeatures, count, region);
}

}  // namespace reflines

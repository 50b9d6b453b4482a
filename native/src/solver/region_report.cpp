#include "solver/region_report.h"

#include <algorithm>

#include "solver/face_count.h"

namespace reflines {
namespace {

std::string format_face_count(int count) { return std::to_string(count) + (count == 1 ? " face" : " faces"); }

std::string format_features(int count) {
  return format_face_count(count) +
         " bend far more than the panel, and run on (fillets, hems, gaps); their lines are kept.";
}

int count(const HeightField& field, VertexRole role) {
  return static_cast<int>(std::count(field.role.begin(), field.role.end(), role));
}

}  // namespace

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
  if (region.turned_away > 0) {
    region.messages.push_back(format_face_count(region.turned_away) +
                              " turned away from the view or folded over: left as they are.");
  }
  const std::string fate = creases_held ? "held" : "kept sharp";
  if (const int found = region.creases - region.marked_creases; found > 0) {
    region.messages.push_back(std::to_string(found) + (found == 1 ? " edge bends" : " edges bend") +
                              " too sharply for a fair panel (gaps, folds, hems); " + fate +
                              ", the lines are solved on each side.");
  }
  if (const int marked = region.marked_creases; marked > 0) {
    region.messages.push_back(std::to_string(marked) + (marked == 1 ? " edge is" : " edges are") +
                              " marked as creases; " + fate + ", the lines are solved on each side.");
  }
  if (region.silhouettes > 0) {
    region.messages.push_back(format_face_count(region.silhouettes) +
                              " seen nearly edge on (less than 12 degrees): left as they are.");
  }
  return region;
}

std::string explain_no_free_vertex(const Region& region, int faces, int doubled) {
  if (doubled > 0) {
    return "No vertex of the region is free to move: " + format_face_count(faces) + ": " + std::to_string(doubled) +
           (doubled == 1 ? " vertex lies on another" : " vertices lie on others") +
           ", so that faces that touch are not joined; use Merge by Distance first.";
  }
  const std::string creases = std::to_string(region.creases) + (region.creases == 1 ? " edge" : " edges");
  return "No vertex of the region is free to move (" + format_face_count(faces) + ": all vertices are held by " +
         (region.creases > 0 ? "creases (" + creases + "), " : "") +
         "the border, silhouettes or faces turned away); select a larger region, or a border that holds less (Fixed or "
         "Free)" +
         (region.creases > 0 ? ", or set Creases to Marked or None." : ".");
}

void add_piece_messages(Region& region) {
  if (region.unused_pieces > 0) {
    region.messages.push_back(std::to_string(region.unused_pieces) + " of " + std::to_string(region.pieces) +
                              " pieces have no free vertex and stay as they are.");
  }
  if (region.hidden > 0) {
    region.messages.push_back("The lines are not defined on " + format_face_count(region.hidden) +
                              " that mirror the view almost along the light lines; little or no weight there.");
  }
}

void add_eye_message(const std::vector<Vector>& sight, Region& region) {
  std::string blind;
  for (size_t k = 0; k < sight.size(); ++k) {
    if (sight[k].isZero(0)) blind += (blind.empty() ? "" : ", ") + std::to_string(k);
  }
  if (blind.empty()) return;
  region.messages.push_back(
      "Turned away from these eyes or hidden from them, the region has no weight there: " + blind + ".");
}

void set_feature_count(int count, Region& region) {
  if (count == region.features) return;
  std::erase(region.messages, format_features(region.features));
  region.features = count;
  if (count > 0) region.messages.push_back(format_features(count));
}

}  // namespace reflines

#include "native/region.h"

#include <algorithm>

namespace reflines {
namespace {

std::string features_message(int count) {
  return count_of_faces(count) +
         " bend far more than the panel, and run on (fillets, hems, gaps); their lines are kept.";
}

int count(const HeightField& field, VertexRole role) {
  return static_cast<int>(std::count(field.role.begin(), field.role.end(), role));
}

}  // namespace

std::string count_of_faces(int count) { return std::to_string(count) + (count == 1 ? " face" : " faces"); }

Region describe(const HeightField& field, bool creases_held) {
  Region region;
  region.triangles = field.triangle_count();
  region.pieces = field.piece_count;
  region.silhouettes = field.silhouette_count;
  region.turned_away = field.turned_away_count;
  region.creases = field.crease_count;
  region.closed = field.closed;
  region.free = count(field, VertexRole::kFree);
  region.fixed = count(field, VertexRole::kFixed);
  region.clamped = count(field, VertexRole::kClamped);
  if (region.turned_away > 0) {
    region.messages.push_back(count_of_faces(region.turned_away) +
                              " turned away from the view or folded over: left as they are.");
  }
  if (region.creases > 0) {
    region.messages.push_back(
        std::to_string(region.creases) + (region.creases == 1 ? " edge bends" : " edges bend") +
        " too sharply for a fair panel (gaps, folds, hems); " +
        (creases_held ? "held, the lines are solved on each side." : "kept sharp, the lines are solved on each side."));
  }
  if (region.silhouettes > 0) {
    region.messages.push_back(count_of_faces(region.silhouettes) +
                              " seen nearly edge on (less than 12 degrees): left as they are.");
  }
  return region;
}

void tell_pieces(Region& region) {
  if (region.unused_pieces > 0) {
    region.messages.push_back(std::to_string(region.unused_pieces) + " of " + std::to_string(region.pieces) +
                              " pieces have no free vertex and stay as they are.");
  }
  if (region.hidden > 0) {
    region.messages.push_back("The lines are not defined on " + count_of_faces(region.hidden) +
                              " that mirror the view almost along the light lines; little or no weight there.");
  }
}

void tell_features(int count, Region& region) {
  if (count == region.features) return;
  std::erase(region.messages, features_message(region.features));
  region.features = count;
  if (count > 0) region.messages.push_back(features_message(count));
}

}  // namespace reflines

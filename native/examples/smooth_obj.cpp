// Takes flaws out of the reflection lines of a panel: reads a Wavefront OBJ of triangles, writes it with moved
// vertices.
//
//   smooth_obj INPUT.obj OUTPUT.obj [LENGTH]
//
// The view looks down the z axis (towards the side that the view direction +z points to), the light lines run along y,
// and the border keeps its position. LENGTH is the size of the flaws in the mesh's unit of length.
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "reflines/errors.h"
#include "reflines/smooth_panel.h"

namespace {

struct Mesh {
  reflines::Positions V;
  reflines::Triangles F;
};

// Reads the `v` and triangular `f` lines; other lines, and texture and normal indices, are skipped.
Mesh read_obj(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw reflines::InvalidInput(path + " cannot be read.");
  std::vector<double> positions;
  std::vector<int> corners;
  for (std::string line, kind, corner; std::getline(file, line);) {
    std::istringstream words(line);
    words >> kind;
    if (kind == "v") {
      for (double x; words >> x;) positions.push_back(x);
    } else if (kind == "f") {
      const size_t before = corners.size();
      while (words >> corner) corners.push_back(std::stoi(corner) - 1);
      if (corners.size() != before + 3) throw reflines::InvalidInput(path + " holds other faces than triangles.");
    }
    kind.clear();
  }
  if (positions.size() % 3 != 0) throw reflines::InvalidInput(path + " holds vertices without 3 coordinates.");
  return {Eigen::Map<reflines::Positions>(positions.data(), static_cast<int>(positions.size()) / 3, 3),
          Eigen::Map<reflines::Triangles>(corners.data(), static_cast<int>(corners.size()) / 3, 3)};
}

void write_obj(const std::string& path, const reflines::Positions& V, const reflines::Triangles& F) {
  std::ofstream file(path);
  file.precision(17);
  for (const auto& v : V.rowwise()) file << "v " << v << '\n';
  for (const auto& f : F.rowwise()) file << "f " << (f.array() + 1) << '\n';
}

void smooth_obj(const std::string& input, const std::string& output, double length) {
  const Mesh mesh = read_obj(input);
  reflines::SmoothPanelOptions options;
  options.border.assign(mesh.V.rows(), reflines::Border::kFixed);
  options.length = length;
  const auto [positions, report] = reflines::smooth_panel(mesh.V, mesh.F, {0, 0, 1}, {0, 1, 0}, options);
  std::cout << "largest move " << report.largest_move << ", worst deviation of lines " << report.healed.worst_before
            << " -> " << report.healed.worst_after << " degrees\n";
  write_obj(output, positions, mesh.F);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3 && count != 4) {
    std::cerr << "usage: smooth_obj INPUT.obj OUTPUT.obj [LENGTH]\n";
    return 2;
  }
  try {
    smooth_obj(arguments[1], arguments[2], count == 4 ? std::stod(arguments[3]) : 0.0);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

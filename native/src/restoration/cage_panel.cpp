#include "restoration/cage_panel.h"

#include <utility>

#include "geometry/cage_border.h"
#include "solver/cage_surface.h"

namespace reflines {
namespace {

// Returns the refined faces outside the region that have a vertex of it, as triangles. `number` (#refined) are the
// region's vertices, -1 elsewhere.
Surroundings find_around(const Subdivision& whole, const Mask& region, const Positions& cage,
                         const std::vector<int>& number, int own) {
  const auto pieces = static_cast<int>(whole.faces.cols()) - 2;
  std::vector<Eigen::RowVector3i> triangles;
  for (Eigen::Index f = 0; f < whole.faces.rows(); ++f) {
    if (region(whole.face_parent(f))) continue;
    bool touches = false;
    for (const int v : whole.faces.row(f)) touches = touches || number[v] >= 0;
    for (int k = 0; k < pieces && touches; ++k)
      triangles.emplace_back(whole.faces(f, 0), whole.faces(f, k + 1), whole.faces(f, k + 2));
  }
  const Positions places = triangles.empty() ? Positions(0, 3) : Positions(whole.positions * cage);
  std::vector<int> other(number), beside;
  Surroundings around;
  around.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      int& v = other[triangles[t](i)];
      if (v < 0) {
        v = own + static_cast<int>(beside.size());
        beside.push_back(triangles[t](i));
      }
      around.F(static_cast<Eigen::Index>(t), i) = v;
    }
  }
  around.V = places(beside, Eigen::all);
  return around;
}

}  // namespace

CagePanel read_surface(const JointPanel& panel) {
  const JointCage& own = *panel.cage;
  const CageSurface surface = make_cage_surface(own.cage, own.V, panel.view_direction, own.options);
  const Subdivision whole = subdivide(own.cage, own.options.subdivision, own.options.shape.progress.get());
  Mask region = own.options.region;
  if (region.size() == 0) region = Mask::Constant(own.cage.face_offsets.size() - 1, true);
  std::vector<Border> border = own.options.border;
  if (border.empty()) border.assign(own.cage.vertices, Border::kClamped);
  const std::vector<Border> refined_border = refine_border(whole, region, border);
  CagePanel result{panel, IndexVector::Constant(surface.refined.size(), -1)};
  std::vector<int> number(whole.positions.rows(), -1);
  SmoothPanelOptions& options = result.panel.options;
  options.border.clear();
  options.held = options.fair_border = {};
  options.partner = {};
  for (int v = 0; v < surface.refined.size(); ++v) {
    const int refined = surface.refined(v);
    number[refined] = v;
    options.border.push_back(refined_border[refined]);
    if (refined < own.cage.vertices) result.corner(v) = refined;
  }
  options.face_of_triangle = surface.parent;
  if (own.options.image_of.size() > 0) options.face_of_triangle = own.options.image_of(surface.parent);
  options.around = find_around(whole, region, own.V, number, static_cast<int>(surface.refined.size()));
  result.panel.V = surface.positions;
  result.panel.F = surface.F;
  return result;
}

JointCage free_border(JointCage cage, const IndexVector& corner, const Mask& marked) {
  std::vector<Border>& border = cage.options.border;
  if (border.empty()) border.assign(cage.cage.vertices, Border::kClamped);
  for (Border& each : border) {
    if (continues_lines(each)) each = Border::kClamped;
  }
  for (int v = 0; v < corner.size(); ++v) {
    if (marked(v) && corner(v) >= 0) border[corner(v)] = Border::kFree;
  }
  return cage;
}

}  // namespace reflines

// Targets by handles: points and curves through which a reflection line is pulled, and pins where lines stay.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reflines/region_field.h"
#include "reflines/spd_factorize.h"
#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

class LineReader;
class SmoothChange;
struct HandlePlace;
struct Incidence;

enum class HandleKind {
  kPull,  // the line of one value of theta passes through the point, or runs along the polyline
  kPin,   // the lines at the point, along the polyline, or in the triangles stay
};

// One handle; coordinates are in the image plane, those of RegionField.
struct Handle {
  HandleKind kind = HandleKind::kPull;
  PlanePositions points;  // #P x 2: one point, or the corners of a polyline
  double value = 0.0;     // of a pull: theta of the line, radians; any multiple of 2 pi may be added
  // The region of a pull: lines farther than `radius` from `centre` (#C x 2, a point or polyline; empty: `points`)
  // stay. As long as these are the same, moving `points` takes one back substitution.
  PlanePositions centre;
  double radius = 0.0;
  IndexVector triangles;  // of a pin: numbers of the region's triangles whose lines stay
  std::string name;       // by which messages call it
};

// The distance between a handle and its line, at the farthest of its points. Of a pin it is the move of its lines.
struct HandleResidual {
  double theta = 0.0;     // radians beside the wanted value, at the farthest point
  double distance = 0.0;  // along the surface, the mesh's unit of length
  double fraction = 0.0;  // of the spacing of the lines
};

// The builder of targets for a region as its lines are when this is made. The wanted change of theta, c, is the
// smoothest function (bi-Laplacian) with the handles' changes at their points that is 0 at pins and beyond the radii.
// The first target is the present field plus grad c, as far as heights can follow it; the others fit theta itself (eq.
// 3): the second around pulls, where the gradient alone reaches a third to three quarters of the change, and beyond the
// radii, the third at the handles, which are to be met.
// Handles that change nothing give the present field bit for bit.
//
// A fall-off map says where lines may follow, within the radii: where it is 0 they stay, as beyond the radii, and where
// it is 1 they are free. Between, what holds them falls by equal factors, and the handles are still met.
class LineHandles {
 public:
  // `changeable` (#F): triangles with a vertex that can move. `falloff`: the map, #V in [0, 1]; empty is 1 everywhere.
  // Keeps copies of its arguments. Throws InvalidInput for a map that is none.
  LineHandles(RegionField field, const Mask& changeable, SpdFactorize factorize, const Vector& falloff = {});
  ~LineHandles();

  // Builds the three targets. Throws InvalidInput: no pull, a number that is not finite, a point off the region or on a
  // feature, a radius that is not positive or covers hardly any vertex, a point outside its own radius.
  std::vector<Target> build(const std::vector<Handle>& handles);

  // Returns a sentence for each pair of pulls that forces lines to cross, with the two names.
  std::vector<std::string> find_conflicts(const std::vector<Handle>& handles) const;

  int family() const;
  const RegionField& field() const { return *field_; }  // as it was when this was made

  // These are the parts that `build` puts together, for those who follow handles otherwise: the places of each handle
  // (of a curve those where lines can be laid, see can_follow), the vertices (#V) whose lines may change, how firmly
  // the map holds those in a triangle (0 to 1e4, relative to the fourth power of the radius), and the weight of the
  // values in a triangle beyond these, where the map holds, or around a pull.
  using Places = std::vector<std::vector<HandlePlace>>;
  Places find_places(const std::vector<Handle>& handles) const;
  Mask find_part(const std::vector<Handle>& handles, const Places& places) const;
  double measure_firmness(int triangle) const;
  double weigh_values(const std::vector<Handle>& handles, const Mask& part, int triangle) const;

  // Returns theta of the line through each point (#P), radians in [-pi, pi]. Throws InvalidInput as `build` does.
  Vector read_theta(const PlanePositions& points) const;

  // Returns whether the line at each point (#P) can be laid elsewhere: not beside a border that holds, on a feature, or
  // off the region.
  Mask can_follow(const PlanePositions& points) const;

  // Returns what the lines in `now`, the region at other heights, have reached. `line_step` is the step of theta from
  // one line to the next, radians.
  std::vector<HandleResidual> measure(const std::vector<Handle>& handles, const RegionField& now,
                                      double line_step) const;

 private:
  bool can_lay(int triangle) const;
  Vector compute_change(const std::vector<Handle>& handles, const Places& places, double radius);
  void weight_places(const std::vector<Handle>& handles, const Places& places, Vector& weight) const;

  std::unique_ptr<const RegionField> field_;
  Mask movable_;              // #V: vertices whose lines can change
  Vector firmness_;           // #V: how firmly the map holds lines that may change
  double value_scale_ = 0.0;  // factor of weights that the energy multiplies values by
  SpdFactorize factorize_;
  std::unique_ptr<const LineReader> reader_;
  std::unique_ptr<const Incidence> triangles_of_vertex_;
  std::unique_ptr<const SmoothChange> change_;  // that of the last handles; null before
};

}  // namespace reflines

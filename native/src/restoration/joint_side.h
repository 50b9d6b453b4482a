// One panel of several that are pressed together, which takes the steps of JointSmoother one by one.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "geometry/nearest_surface.h"
#include "reflines/gap_continuation.h"
#include "reflines/joint_smoother.h"
#include "restoration/cage_panel.h"
#include "restoration/control_range.h"
#include "restoration/controlled_surface.h"
#include "restoration/joined_mesh.h"
#include "restoration/press.h"
#include "restoration/restoration.h"
#include "restoration/tangent_match.h"
#include "restoration/used_vertices.h"

namespace reflines {

// Surfaces in space.
struct Skin {
  Positions V;
  Triangles F;
};

// The place of another side's rim across from a vertex: between the ends of an edge.
struct RimPlace {
  double distance;
  int first, second;
  double fraction;  // of the second end
};

// A change of heights (#V), and by how many degrees, at most, it turns a border.
struct Turn {
  Vector change;
  double degrees = 0;
};

// The part that a side has in making its flush even.
struct FlushPart {
  IndexVector across;  // #V: the side that a vertex of the rim lies across from, or -1
  Vector taken;        // #V: fraction of the uneven flush that this side takes away
};

// An uneven flush, and what mends it.
struct UnevenFlush {
  double most = 0;  // by which it is off its even course
  Vector change;    // of heights, #V
};

class JointSide {
 public:
  JointSide(const CagePanel& panel, const PressAmount& amount);
  JointSide(const JointSide&) = delete;  // parts refer to others

  // Finds by the shape at the start where the border faces the others, and where what stays.
  void face(const Skin& others);
  bool is_joint() const { return joint_.any(); }  // whether it faces others somewhere

  Eigen::AlignedBox3d box() const;    // at the start
  void widen_flaws(double diagonal);  // looks for flaws as long as those of a joint panel of this diagonal

  SmoothPanelResult press_alone(const PressAmount& amount);    // as smooth_panel does
  SmoothPanelResult press_clamped(const PressAmount& amount);  // towards the others

  void begin(const PressAmount& amount);  // the steps: nothing has moved yet
  Skin skin(double fraction = 1) const;   // at present, or at a fraction of the move

  // Returns by how much the flush towards the others is uneven after a fraction of the move, and the change of heights
  // (#V) that takes this side's part of it away. There is none where it is not seen.
  UnevenFlush find_uneven_flush(const Skin& others, const FlushPart& part, double fraction = 1) const;
  void begin_evened(const Vector& change);  // from the start, instead of begin()

  // Returns the change that turns the border's tangents towards the others as all are at present: half of the way to
  // those, and the whole way to what stays. `lengths` is how far from the border it reaches.
  Turn find_turn(const Skin& others, double lengths) const;
  void begin_turned(const Vector& change);                    // from the start, instead of begin()
  void press(const Skin& others, const PressAmount& amount);  // finds the move together with the others' continuation
  void even(const Vector& change);  // moves the joint rim by this (#V) more, and what is near it by less and less
  // Makes all moves saturate at their limit, see ControlRange: a solve within it takes minutes beside a dent that goes
  // on in the others.
  void saturate();
  void turn_after(const Vector& change);

  // Replaces the move of a cage's surface by what the cage can take of it; the first time by the fraction that makes
  // its lines more even.
  void take_shape();
  void make_firm() { firm_ = true; }  // from now on others follow its rim
  bool is_cage() const { return panel_.cage != nullptr; }
  bool is_firm() const { return firm_; }

  SmoothPanelResult judge(const PressAmount& amount);  // positions are those of the control vertices

  const Mask& joint() const { return joint_; }  // #V: border vertices that face others and move with them
  double shift(int v) const { return move_(v) - evened_(v); }  // of a vertex so far, beside what evened its flush
  bool is_beyond_limit() const { return limited_ > 0; }        // after even()
  Vector3 axis() const { return region_->optimizer().frame().z(); }
  Vector3 place(int v) const { return V_.row(v); }  // at the start
  const IndexVector& partner() const { return is_cage() ? panel_.cage->options.partner : shape_.partner; }
  double gap() const { return gap_; }  // the widest

  // Finds the nearest place of the rim at the start, no further than `within`; the distance is infinite where there is
  // none.
  RimPlace find_rim(const Vector3& point, double within) const;

 private:
  GapContinuation continue_region(const Positions& V, const Surroundings& around, const Skin& beside,
                                  double margin) const;
  GapContinuation take_around() const;  // the faces around, which are followed
  JoinedMesh join(const Positions& V, const Skin& others) const;
  ShapeOptions choose_joined_shape(const JoinedMesh& joined) const;
  ShapeOptions clamp_joint() const;
  Positions present(double fraction) const;  // #V x 3
  void build_region();
  double weigh_gain() const;
  SmoothPanelResult read_cage(SmoothPanelResult surface, const PressAmount& amount) const;
  void add(const Vector& change);

  const JointPanel& panel_;
  const IndexVector& corner_;  // see CagePanel
  UsedVertices used_;          // in the panel; the other numbers are of these
  Positions V_;
  Triangles F_;
  std::vector<Vector3> families_;
  ShapeOptions shape_, own_;  // own_: the region alone, its joint rim free
  SmoothPanelOptions options_, joint_options_;
  double gap_ = 0, widened_ = 1;  // see widen_flaws
  Mask joint_, still_;            // #V: border vertices that follow the others, and what stays
  GapContinuation rings_still_;   // of what stays, at the start
  Triangles rim_;                 // edges of the border: first, second, second
  NearestSurface rim_tree_;
  std::vector<Border> turned_border_;  // #V: kFollow where it is turned
  std::unique_ptr<MeshSurface> region_;
  std::unique_ptr<Restoration> alone_;  // tells length and limit
  Mask free_;                           // #V
  std::unique_ptr<ControlRange> range_;
  Vector move_, turned_, beside_;  // #V, #V, #vertices beside: moves of the region, of it before press(), and beside it
  Vector evened_;                  // #V: part of turned_
  int limited_ = 0;                // vertices whose move is beyond the limit
  JoinedMesh joined_;              // at press()
  std::unique_ptr<MeshSurface> surface_;
  std::unique_ptr<Restoration> press_;
  std::unique_ptr<Press> other_;  // alone or clamped
  // These are of a cage alone.
  std::unique_ptr<CageControlledSurface> cage_;
  std::unique_ptr<ControlRange> control_range_;
  Vector control_;     // #C: moves of its vertices, after take_shape()
  double gain_ = 1.0;  // fraction of the move that it makes when it takes it first
  bool firm_ = false;
};

}  // namespace reflines

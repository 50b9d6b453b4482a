// The codes and numbers by which the library tells more than counts; the caller words them for its users.
#pragma once

namespace reflines {

enum class NoteKind {
  // These are of a press that moved nothing.
  kFacesWouldTurn,    // by more than 45 degrees
  kLightWouldWorsen,  // the unevenness of one light would have risen from `before` to `after` degrees
  kNoStrength,        // the strength is 0
  kNoFlaws,           // no noise, ripples or dents were found
  // These are of a press that moved something.
  kLimited,       // the limit holds `count` vertices back
  kLongerWaves,   // were left, for they may be design; see SmoothPanelReport::longer_waves
  kUnfinished,    // the solver stopped before its end; the lines are more even in every light all the same
  kHeldFaces,     // `count` faces were left alone that would have turned by more than 45 degrees
  kBorderTurned,  // to follow its neighbours, by up to `after` degrees
  // These are of a press's border that is not as it was wanted.
  kFollowingWorsens,   // it is clamped: following its neighbours, lines would have become less even
  kJoiningWorsens,     // clamped: smoothed across the gap as one with its neighbours, lines would have become less even
  kContinuingWorsens,  // clamped: with its curvature continued, lines deviate by `after` instead of `before` degrees
  kContinuingChangesNothing,  // clamped: with its curvature continued, nothing could have been changed
  kContinuingFails,           // clamped: with its curvature continued, the solver breaks down
  kNotFaired,                 // held: no faces beside the region tell where it should run
  kPartlyFaired,              // held at `count` vertices for that reason
  // These are of a region.
  kTurnedAway,              // `count` faces turned away from the view or folded over are left as they are
  kSharpEdges,              // `count` edges that bend too sharply for a fair panel are held
  kSharpEdgesKept,          // likewise of a cage: they move, and stay sharp
  kMarkedEdges,             // `count` edges that are marked as creases are held
  kMarkedEdgesKept,         // likewise of a cage
  kEdgeOn,                  // `count` faces seen at less than 12 degrees are left as they are
  kUnusedPieces,            // `count` of Region::pieces have no free vertex
  kHiddenFaces,             // `count` faces mirror the view almost along the light lines, and have little weight
  kUnseen,                  // the eye of the family with the index `count` sees nothing: it has no weight
  kFeatures,                // the lines of `count` faces are kept: strong bends that run on
  kCurvatureUnknown,        // no faces beside the region tell the curvature of its border, which is clamped
  kCurvaturePartlyUnknown,  // likewise at `count` vertices
  kStrongBorderBend,        // the surface bends strongly at `count` vertices of the border, which is clamped there
  kFlowUnknown,             // the rate of the border's curvature is not known at `count` vertices, and kept at 0
};

const char* to_string(NoteKind kind);  // "faces_would_turn", "light_would_worsen", ...

struct Note {
  NoteKind kind;
  int count = 0;
  double before = 0.0, after = 0.0;

  bool operator==(const Note&) const = default;
};

}  // namespace reflines

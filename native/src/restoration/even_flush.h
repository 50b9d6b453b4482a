// The even course of the flush along shut lines, and how far the flush is off it.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// Vertices that follow each other along a rim without a corner.
struct RimRun {
  std::vector<int> vertices;
  bool closed = false;  // the last is beside the first
};

// Finds the runs of a rim, whose edges are (first, second, second) in the order of the region's triangles, over edges
// whose ends lie across from the same other side (#V, or -1: from none): up to corners of 40 degrees.
std::vector<RimRun> find_rim_runs(const Positions& V, const Triangles& rim, const IndexVector& across);

// Returns by how much the flush (#V) is off its even course along a run, one number a vertex. The course is straight
// from one end to the other, where the corners of panels stay; of a closed run it is the mean.
Vector find_uneven_flush(const Positions& V, const RimRun& run, const Vector& flush);

}  // namespace reflines

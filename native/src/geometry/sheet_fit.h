// The local fit of a sheet: a polynomial nearest to its vertices around a place.
#pragma once

#include <optional>

#include "geometry/neighbor_sheets.h"
#include "reflines/types.h"

namespace reflines {

struct SheetPoint {
  Vector3 place;   // of the sheet, along the normal given
  Vector3 normal;  // of the sheet there
  Vector3 x, y;    // axes across the normal given
  Vector2 slope;   // of the sheet's height over them
  Vector3 second;  // its second derivatives f_xx, f_xy, f_yy
};

// Fits the sheet around its triangle t over the plane through `at` across `normal`. The weights of vertices fall to
// zero with their distance, so that fits at near places are alike. Empty where the vertices around tell nothing.
std::optional<SheetPoint> fit_sheet(const NeighborSheets& sheets, int t, const Vector3& at, const Vector3& normal);

}  // namespace reflines

// The kinds of surface: what moves the vertices of a region, on which the rules of a solve depend.
#pragma once

namespace reflines {

enum class SurfaceKind {
  kMesh,        // every vertex is one of the artist's: it moves by itself, or with its mirror image
  kSubdivided,  // the vertices follow the cage of a subdivision surface: smoothly from triangle to triangle, and across
                // creases
};

}  // namespace reflines

// The discretizations of second derivatives on a triangle mesh (paper, section 3 and appendix).
#pragma once

namespace reflines {

// The method by which the Hessian of a triangle is computed from the heights around it.
enum class StencilKind {
  kAveraged,    // eq. 6 as re-derived: jumps of the gradient over the three edges; consistent on regular meshes only
  kQuadratic,   // the quadratic through the six points (appendix), kAveraged on the region's border, where there are
                // fewer; throws where the points lie on a conic or coincide (valence three)
  kHybrid,      // the paper's: kQuadratic, and kAveraged where a coefficient exceeds 5 / l_max^2
  kConsistent,  // kQuadratic, and where that is unstable the minimum-norm weights over the ring of triangles touching T
};

}  // namespace reflines

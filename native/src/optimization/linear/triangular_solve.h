// Triangular solves with a supernodal factor, on subtrees of its elimination tree at the same time.
#pragma once

#include <vector>

#include "optimization/linear/elimination_subtrees.h"
#include "optimization/linear/supernodal_factor.h"
#include "reflines/types.h"

namespace reflines {

// Solves L y = b and L^T x = y, subtrees of the elimination tree on all cores, and the supernodes above them on one. A
// solve reads the factor twice and is limited by the speed of the memory (see column_sweep.h): milliseconds of
// CHOLMOD's and of this for 100,000 unknowns on one core: 22 and 18.
class TriangularSolve {
 public:
  // Takes a factor whose structure stays, and its tree; the values may change between solves.
  TriangularSolve(const SupernodalFactor& factor, const EliminationSubtrees& tree);

  void solve_lower(Vector& x);  // x (n) <- L^-1 x, in the order of elimination
  void solve_upper(Vector& x);  // x (n) <- L^-T x

 private:
  struct Workspace {
    Vector above;  // #columns above all subtrees: what a subtree adds there
    Vector below;  // for the rows below a supernode
    Vector column;
  };
  struct Supernode;

  Supernode supernode(int s) const;
  void solve_lower(const EliminationSubtrees::Range& subtree, Vector& x, Workspace& work) const;
  void solve_lower_above(Vector& x);
  void solve_upper(int s, Vector& x, Vector& reached) const;

  SupernodalFactor factor_;
  EliminationSubtrees tree_;
  std::vector<int> place_above_;  // n: of the columns above all subtrees in their order, else -1
  std::vector<Workspace> work_;   // #subtrees
  Vector below_, column_;
};

}  // namespace reflines

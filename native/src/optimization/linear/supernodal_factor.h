// The arrays of a supernodal Cholesky factor.
#pragma once

namespace reflines {

// The arrays of a supernodal factor L (n x n), as CHOLMOD has them: a supernode is a range of columns with the same
// rows below, stored as one dense block whose first rows are those of the columns themselves.
struct SupernodalFactor {
  int size, supernode_count;
  const int* first_column;  // #supernodes + 1
  const int* row_start;     // #supernodes + 1: into `row`
  const int* block_start;   // #supernodes: into `value`
  const int* row;
  double* value;

  int columns(int s) const { return first_column[s + 1] - first_column[s]; }
  int height(int s) const { return row_start[s + 1] - row_start[s]; }
  int below(int s) const { return height(s) - columns(s); }
  const int* rows_below(int s) const { return row + row_start[s] + columns(s); }
  double* block(int s) const { return value + block_start[s]; }  // height x columns
};

}  // namespace reflines

// The scalar, index and array types of the library, and the choice of a Hessian model. One scalar (double), one index
// (int).
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace reflines {

using Vector = Eigen::VectorXd;  // #V
using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;       // V, #V x 3
using PlanePositions = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;  // xy, #V x 2
using PlaneVectors = PlanePositions;                                               // one 2-vector a triangle, #F x 2
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;          // F, #F x 3
using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;              // #E x 2, vertices
using IndexVector = Eigen::VectorXi;
using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

// Second-order models of an energy, shared by those who assemble and those who minimise. All are positive
// semi-definite.
enum class HessianModel {
  kLinearized,   // constant: the Hessian of the energy linearised about flat slopes (the paper, section 3.1)
  kGaussNewton,  // J^T J at x
  kNewton,       // full second derivatives at x, projected to positive semi-definite element by element
};

// The number of vertices or triangles from which a loop runs on several threads: a shorter loop takes less than a
// millisecond, and waking a second thread, or waiting for one that another program delays, costs more than it gains.
constexpr int kWorthThreads = 30000;

}  // namespace reflines

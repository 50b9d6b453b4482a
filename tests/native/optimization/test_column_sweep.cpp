// The sweeps over one block of a factor: dense triangular solves, whatever the number of its columns and rows.
#include <gtest/gtest.h>

#include <limits>

#include "optimization/linear/column_sweep.h"
#include "reflines/types.h"

namespace reflines {
namespace {

// A block with a triangle far from singular, and with no numbers where none may be read.
Eigen::MatrixXd make_block(int columns, int below) {
  Eigen::MatrixXd block(columns + below, columns);
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < columns + below; ++i) block(i, j) = ((7 * i + 3 * j) % 11 - 5) / (5.0 * columns);
    block.col(j).head(j).setConstant(std::numeric_limits<double>::quiet_NaN());
    block(j, j) = 1.0 + j % 3;
  }
  return block;
}

// Without a panel and with several, with and without a rest; more columns than are summed in one group.
TEST(ColumnSweep, SolvesWithTheTriangleAndMultipliesTheRowsBelow) {
  for (const int columns : {1, 2, 7, 8, 9, 16, 21, 127, 128, 150}) {
    for (const int below : {0, 1, 2, 40, 81}) {
      const Eigen::MatrixXd block = make_block(columns, below);
      const FactorBlock factor{columns, below, block.data()};
      const Eigen::MatrixXd B = block.bottomRows(below);
      const auto L = block.topRows(columns).triangularView<Eigen::Lower>();
      const Vector x = Vector::LinSpaced(columns, -1.0, 2.0), r = Vector::LinSpaced(below, 1.0, 3.0);

      Vector solved = x, products = Vector::Constant(below, 7.0), work(columns + below);
      sweep_forward(factor, solved.data(), products.data(), work.data());
      EXPECT_LT((L * solved - x).norm(), 1e-13 * x.norm()) << columns << " x " << below;
      EXPECT_LE((products - B * solved).norm(), 1e-13 * (B * solved).norm()) << columns << " x " << below;

      solved = x;
      sweep_backward(factor, r.data(), solved.data());
      const Vector right = x - B.transpose() * r;
      EXPECT_LT((L.transpose() * solved - right).norm(), 1e-13 * right.norm()) << columns << " x " << below;
    }
  }
}

}  // namespace
}  // namespace reflines

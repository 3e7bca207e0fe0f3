#pragma once

#include <Eigen/Core>

#include "core/geometry/calibration_board.h"
#include "core/random/random_stream.h"

namespace fenestra {

/// How far boards as made are from their drawing: standard deviations of independent normal laws,
/// relative to the board, as larger boards are less flat and less exact.
///
/// The bow is that of the chessboard in OpenCV's stereo samples, adjusted together with the cameras
/// (0.24 mm of 366 mm); lines are what makes its corners' residuals, 0.131 px a coordinate, where
/// pictures have no more noise than simulated ones. Adjusted together with its cameras, StereoPi's
/// sheet has such lines (0.09 mm of 26 mm), and three times that bow.
struct BoardTolerances {
  /// Of each of three shapes, as a share of the diagonal: bow along rows, along columns, twist.
  double bow = 6.6e-4;
  /// Error of each line between rows or columns of squares, as a share of a square's side.
  double line_error = 3.4e-3;
  double print_scale = 2e-4;       ///< Common to both axes. Assumed: it was measured afterwards.
  double print_anisotropy = 2e-4;  ///< Of one axis against the other. Assumed.

  bool operator==(const BoardTolerances&) const = default;
};

/// A board exactly as drawn.
inline constexpr BoardTolerances kAsDrawn{
    .bow = 0.0, .line_error = 0.0, .print_scale = 0.0, .print_anisotropy = 0.0};

/// Throws InputError with all faults.
void Validate(const BoardTolerances& tolerances);

/// A board as made: where the points of the drawing are. With q from the board's centre, D the
/// diagonal, and ξ, η from -1 to 1 across the board,
///
///     Δx = ε_x q_x + e_x(x),   Δy = ε_y q_y + e_y(y)      ε = scale ± anisotropy / 2
///     Δz = D (b₁ ξ² + b₂ η² + b₃ ξη)
///
/// e belongs to the lines between columns (rows) of squares, is linear between them and constant
/// beyond: in recorded boards some 80 % of the variance of corners' errors is common to a line, as
/// printers feed paper and scan unevenly.
class BoardShape {
 public:
  /// Draws the board that belongs to the stream.
  BoardShape(const CalibrationBoard& board, const BoardTolerances& tolerances,
             const RandomStream& stream);
  /// The board whose deviations are these multiples of the tolerances; Freedom(board) of them.
  BoardShape(const CalibrationBoard& board, const BoardTolerances& tolerances,
             const Eigen::VectorXd& multiples);

  /// The number of independent deviations.
  static int Freedom(const CalibrationBoard& board) {
    return 5 + board.corner_columns() + board.corner_rows();
  }

  /// Where the drawing's point (x, y) of frame G is, in G [m].
  Eigen::Vector3d At(const Eigen::Vector2d& drawn) const;

  const CalibrationBoard& board() const { return board_; }

 private:
  CalibrationBoard board_;
  Eigen::Vector3d bow_;  ///< b₁, b₂, b₃.
  Eigen::Vector2d strain_;
  Eigen::VectorXd column_errors_m_;  ///< Of the lines between columns, from the left.
  Eigen::VectorXd row_errors_m_;     ///< Of the lines between rows, from the top.
};

}  // namespace fenestra

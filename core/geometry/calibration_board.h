#pragma once

#include <Eigen/Core>

namespace fenestra {

enum class BoardKind {
  kChessboard,
  kCharuco,  ///< A chessboard with an ArUco marker in each white square.
};

/// A flat board of squares for camera calibration. The top left square is black.
///
/// Frame G: origin at the outer top left corner of the top left square, +x right along a row of
/// squares, +y down along a column, +z into the board.
///
/// Corners are the inner ones, where four squares meet: (columns - 1) x (rows - 1) of them,
/// numbered row by row from the top left.
struct CalibrationBoard {
  BoardKind kind = BoardKind::kChessboard;
  int columns = 10;         ///< Squares in a row.
  int rows = 7;             ///< Squares in a column.
  double square_m = 0.06;   ///< Side of a square.
  double marker_m = 0.045;  ///< Side of a marker, its black border included; kCharuco only.

  int corner_columns() const { return columns - 1; }
  int corner_rows() const { return rows - 1; }
  int corner_count() const { return corner_columns() * corner_rows(); }
  double width_m() const { return columns * square_m; }
  double height_m() const { return rows * square_m; }

  /// p_GQ of corner `id` [m].
  Eigen::Vector3d Corner(int id) const {
    const int column = id % corner_columns();
    const int row = id / corner_columns();
    return {(column + 1) * square_m, (row + 1) * square_m, 0.0};
  }

  bool operator==(const CalibrationBoard&) const = default;
};

/// Sides of a marker in cells without its border, and how many different markers there are:
/// OpenCV's DICT_5X5_100. Markers are numbered row by row over the white squares.
inline constexpr int kMarkerCells = 5;
inline constexpr int kMarkerCount = 100;

/// Throws InputError with all faults: fewer than 3 squares a side, more than 64, sides that are not
/// positive, markers that do not fit into their squares or are more than there are. A chessboard
/// must have an odd number of squares along one side and an even one along the other: other
/// boards look the same upside down.
void Validate(const CalibrationBoard& board);

}  // namespace fenestra

#include "core/geometry/calibration_board.h"

#include <fmt/format.h>

#include "core/io/faults.h"

namespace fenestra {

void Validate(const CalibrationBoard& board) {
  Faults faults("calibration board");
  constexpr int kFewest = 3;
  constexpr int kMost = 64;
  faults.Require(board.columns >= kFewest && board.columns <= kMost && board.rows >= kFewest &&
                     board.rows <= kMost,
                 fmt::format("{} x {} squares are not between {} and {} a side", board.columns,
                             board.rows, kFewest, kMost));
  constexpr double kSmallest_m = 0.001;
  constexpr double kLargest_m = 1.0;
  faults.Require(board.square_m >= kSmallest_m && board.square_m <= kLargest_m,
                 fmt::format("squares must have sides of {:g} to {:g} mm, not of {:g} mm",
                             1e3 * kSmallest_m, 1e3 * kLargest_m, 1e3 * board.square_m));
  if (board.kind == BoardKind::kCharuco) {
    faults.Require(board.marker_m > 0.0 && board.marker_m < board.square_m,
                   fmt::format("markers of {} m do not fit into squares of {} m", board.marker_m,
                               board.square_m));
    const int markers = board.columns * board.rows / 2;
    faults.Require(
        markers <= kMarkerCount,
        fmt::format("{} white squares, but only {} different markers", markers, kMarkerCount));
  } else {
    faults.Require(
        (board.columns + board.rows) % 2 == 1,
        fmt::format("a chessboard of {} x {} squares looks the same upside down: one number has "
                    "to be odd and the other one even",
                    board.columns, board.rows));
  }
  faults.ThrowIfAny();
}

}  // namespace fenestra

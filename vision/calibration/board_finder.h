#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/calibration_board.h"

namespace fenestra {

/// A corner of a calibration board in an image.
struct BoardCorner {
  int id;                 ///< See CalibrationBoard.
  Eigen::Vector2d pixel;  ///< To a fraction of a pixel.
};

/// Why no board was found, in words for the user.
struct BoardNotFound {
  std::string reason;
};

using BoardSighting = std::variant<std::vector<BoardCorner>, BoardNotFound>;

/// Finds a board in a grey image: a chessboard wholly or not at all (cv::findChessboardCorners), a
/// ChArUco board also in part, from its markers (cv::aruco). Corners are ordered by id; of the two
/// ways to read a chessboard the one with a black square at the top left counts, so that two
/// cameras agree.
/// Each corner is then located by RefineCorner; one that cannot be is left out.
BoardSighting FindBoard(const cv::Mat1b& image, const CalibrationBoard& board);

}  // namespace fenestra

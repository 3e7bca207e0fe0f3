#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/geometry/calibration_board.h"

namespace fenestra {

/// A corner of a calibration board in an image.
struct BoardCorner {
  int id;                 ///< See CalibrationBoard.
  Eigen::Vector2d pixel;  ///< Accurate to a fraction of a pixel.
};

/// The reason why no board was found, for the user.
struct BoardNotFound {
  std::string reason;
};

using BoardSighting = std::variant<std::vector<BoardCorner>, BoardNotFound>;

/// Finds a board in a grey image: a chessboard only as a whole (cv::findChessboardCorners), a
/// ChArUco board also in part, from its markers (cv::aruco). Corners are ordered by id. Of the two
/// orientations of a chessboard, the one with a black square at the top left is used, so that two
/// cameras agree. Each corner is then located by RefineCorner; corners for which that fails are
/// left out.
BoardSighting FindBoard(const cv::Mat1b& image, const CalibrationBoard& board);

}  // namespace fenestra

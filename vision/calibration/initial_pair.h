#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/calibration/bundle_adjustment.h"

namespace fenestra {

/// Sizes of the images of both cameras [px].
struct PairSizes {
  cv::Size left;
  cv::Size right;
};

/// Number of corners of a view that both cameras saw.
size_t CountShared(const BoardView& view, const CalibrationBoard& board);

/// Initial values for AdjustPair. Each camera is calibrated alone by cv::calibrateCamera, with
/// k3 = 0 unless it is free; then the pose between the cameras is estimated by cv::stereoCalibrate
/// from the corners that both saw, with fixed intrinsics. Board poses are those that the left
/// camera's calibration found.
///
/// The criteria are OpenCV's, unweighted squared pixels, so the result is accurate enough to start
/// from but not optimal: the cameras' parameters are not adjusted jointly.
///
/// Domain: at least three views, each with at least six corners seen by both cameras. Whether they
/// determine the parameters is only known after the joint adjustment.
PairState InitialPair(const std::vector<BoardView>& views, const CalibrationBoard& board,
                      const PairSizes& sizes, const AdjustmentOptions& options);

}  // namespace fenestra

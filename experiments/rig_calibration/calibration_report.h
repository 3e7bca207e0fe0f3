#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "core/geometry/calibration_board.h"
#include "core/io/output_path.h"
#include "vision/calibration/stereo_calibration.h"

namespace fenestra {

/// The result of a calibration for people: how well the views agree, each parameter with its
/// standard deviation, the views that were left out and why.
enum class ReportFormat { kPlain, kMarkdown };
std::string CalibrationReport(const StereoCalibrationResult& result, const CalibrationBoard& board,
                              ReportFormat format);

/// The joint covariance: one row and one column for each parameter, named in the first of them.
std::string CovarianceCsv(const StereoCalibrationResult& result);

/// Where in the images the corners were and by how much they miss, magnified; below, all misses
/// about their centre. Left camera on the left.
cv::Mat3b ResidualPicture(const StereoCalibrationResult& result);

/// Writes stereo.yaml (OpenCV), left.yaml and right.yaml (ROS camera_info, with the pair's
/// rectification), report.md, covariance.csv and residuals.png. Throws InputError if a file cannot
/// be written.
/// The files of WriteCalibration.
inline const std::vector<std::string> kCalibrationFiles = {
    "stereo.yaml", "left.yaml", "right.yaml", "report.md", "covariance.csv", "residuals.png"};

void WriteCalibration(const OutputPath& folder, const StereoCalibrationResult& result,
                      const CalibrationBoard& board);

}  // namespace fenestra

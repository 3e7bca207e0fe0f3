#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/calibration_board.h"
#include "vision/calibration/stereo_calibration.h"

namespace fenestra {

/// The image files that a user means: files as given; of a folder, all files in it whose endings
/// are those of images; of a pattern with * or ? in its last part, those that match. Hidden files
/// only where a file or pattern begins with a dot. Sorted so that view2 comes before view10. Throws
/// InputError for what does not exist or matches nothing.
std::vector<std::filesystem::path> ImageFiles(const std::vector<std::string>& arguments);

/// A pair of pictures of the board.
struct PicturePair {
  std::filesystem::path left;
  std::filesystem::path right;
};

/// Left and right files, first with first. Throws InputError if there are more of one than of the
/// other, if a file is both, or if a left file's numbers ("left05") are those of a right file that
/// it would not be paired with: one of each is missing then.
std::vector<PicturePair> PairUp(const std::vector<std::filesystem::path>& left,
                                const std::vector<std::filesystem::path>& right);

/// Calibrates from picture files, grey or colour, all of one size. Views in which the board is not
/// found are left out with the finder's reason. Throws InputError, with all faults, for files that
/// cannot be read or differ in size, and where CalibrateStereo does; also if the cameras are not
/// apart (5 σ), the right one stands on the left, or detectors cannot rectify the pair.
StereoCalibrationResult CalibrateFromPictures(const std::vector<PicturePair>& pairs,
                                              const CalibrationBoard& board,
                                              const AdjustmentOptions& adjustment);

}  // namespace fenestra

#include "experiments/rig_calibration/board_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/io/faults.h"
#include "core/io/image_io.h"
#include "core/io/input_file.h"
#include "vision/calibration/board_finder.h"
#include "vision/stereo/rectification.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;

bool IsDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// Without the zeros before other digits: "left03" becomes "left3". strverscmp takes "03" for a
// fraction, which comes before every whole number.
std::string WithoutPadding(const std::string& name) {
  std::string bare;
  for (size_t i = 0; i < name.size(); ++i) {
    const bool pads = name[i] == '0' && (bare.empty() || !IsDigit(bare.back())) &&
                      i + 1 < name.size() && IsDigit(name[i + 1]);
    if (!pads) bare += name[i];
  }
  return bare;
}

// Whether `a` comes before `b` where digits compare as numbers.
bool NaturallyLess(const std::string& a, const std::string& b) {
  const int order = strverscmp(WithoutPadding(a).c_str(), WithoutPadding(b).c_str());
  // "view1" and "view01" are in some order, always the same.
  return order != 0 ? order < 0 : a < b;
}

// The files of a folder, or those that match a pattern; none if the folder cannot be read.
std::vector<std::string> FilesIn(const std::string& folder_or_pattern) {
  std::vector<std::string> files;
  try {
    cv::glob(folder_or_pattern, files);
    const bool means_hidden = IsHidden(folder_or_pattern) && !fs::is_directory(folder_or_pattern);
    if (!means_hidden) std::erase_if(files, IsHidden);
  } catch (const cv::Exception&) {
    files.clear();
  }
  return files;
}

// All runs of digits in a file's name, without leading zeros: what tells the pictures of a session
// apart. "left03" and "right3" have the same ones.
std::vector<std::string> NumbersIn(const fs::path& file) {
  std::vector<std::string> numbers;
  bool inside = false;
  for (const char c : WithoutPadding(file.stem().string())) {
    const bool digit = IsDigit(c);
    if (digit && !inside) numbers.emplace_back();
    if (digit) numbers.back() += c;
    inside = digit;
  }
  return numbers;
}

// A pair whose left picture has a namesake on the right, but another one beside it.
std::optional<std::string> WrongPair(const std::vector<PicturePair>& pairs) {
  for (const PicturePair& pair : pairs) {
    std::error_code error;
    if (fs::equivalent(pair.left, pair.right, error)) {
      return fmt::format("{} is both a left and a right picture", pair.left.string());
    }
    const std::vector<std::string> own = NumbersIn(pair.left);
    if (own.empty() || own == NumbersIn(pair.right)) continue;
    const auto namesake = std::find_if(pairs.begin(), pairs.end(), [&](const PicturePair& other) {
      return NumbersIn(other.right) == own;
    });
    if (namesake != pairs.end()) {
      return fmt::format("{} would be paired with {}, not with {}: a picture is missing",
                         pair.left.filename().string(), pair.right.filename().string(),
                         namesake->right.filename().string());
    }
  }
  return std::nullopt;
}

// A baseline that is none, or that points to the wrong side; and whatever else would keep detectors
// from rectifying the pair, one camera above the other for instance.
void CheckBaseline(const StereoCalibrationResult& result) {
  const Eigen::Vector3d t_RL = result.calibration.X_RL.translation();
  const double deviation_m = std::sqrt(result.covariance.diagonal().tail<3>().sum());
  if (t_RL.norm() < 5.0 * deviation_m) {
    throw InputError("calibration",
                     fmt::format("the cameras are {:.2g} ± {:.2g} mm apart: are the left and the "
                                 "right pictures those of one camera?",
                                 1e3 * t_RL.norm(), 1e3 * deviation_m));
  }
  if (t_RL.x() > std::abs(t_RL.y())) {
    throw InputError("calibration",
                     "the right camera stands to the left of the left one: --left and --right are "
                     "swapped");
  }
  const StereoRectification possible(result.calibration, 0.0);
}

cv::Mat1b ReadBoardPicture(const fs::path& file) {
  cv::Mat1b grey;
  cv::cvtColor(ReadColorImage(file), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

std::vector<fs::path> ImageFiles(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  for (const std::string& argument : arguments) {
    const fs::path path(argument);
    std::vector<std::string> found;
    if (fs::is_directory(path)) {
      found = FilesIn(argument);
      // By their endings: an image that cannot be read has to be named, not passed over.
      std::erase_if(found, [](const std::string& file) { return !cv::haveImageWriter(file); });
      if (found.empty()) throw InputError(argument, "there are no images in this folder");
    } else if (fs::exists(path)) {
      found = {argument};
    } else if (argument.find_first_of("*?") != std::string::npos) {
      found = FilesIn(argument);
      if (found.empty()) throw InputError(argument, "no file matches this pattern");
    } else {
      throw InputError(argument, "there is no such file");
    }
    files.insert(files.end(), found.begin(), found.end());
  }
  std::sort(files.begin(), files.end(), NaturallyLess);
  return {files.begin(), files.end()};
}

std::vector<PicturePair> PairUp(const std::vector<fs::path>& left,
                                const std::vector<fs::path>& right) {
  if (left.size() != right.size()) {
    throw InputError("--left, --right",
                     fmt::format("{} left pictures, but {} right ones", left.size(), right.size()));
  }
  std::vector<PicturePair> pairs;
  for (size_t i = 0; i < left.size(); ++i) pairs.push_back({left[i], right[i]});
  if (const auto wrong = WrongPair(pairs)) throw InputError("--left, --right", *wrong);
  return pairs;
}

StereoCalibrationResult CalibrateFromPictures(const std::vector<PicturePair>& pairs,
                                              const CalibrationBoard& board,
                                              const AdjustmentOptions& adjustment) {
  Validate(board);
  Faults faults;
  std::vector<NamedView> views;
  std::vector<LeftOutView> without_board;
  cv::Size size;
  for (const PicturePair& pair : pairs) {
    NamedView view{.name = pair.left.filename().string(), .corners = {}};
    std::string reason;
    for (const bool is_right : {false, true}) {
      const fs::path& file = is_right ? pair.right : pair.left;
      try {
        const cv::Mat1b picture = ReadBoardPicture(file);
        if (size.empty()) size = picture.size();
        if (picture.size() != size) {
          throw InputError(
              file.string(),
              fmt::format("{} x {} px, but the first picture has {} x {}: both cameras "
                          "of a pair must deliver images of one size",
                          picture.cols, picture.rows, size.width, size.height));
        }
        BoardSighting sighting = FindBoard(picture, board);
        if (auto* none = std::get_if<BoardNotFound>(&sighting)) {
          reason += fmt::format("{}{}: {}", reason.empty() ? "" : "; ", is_right ? "right" : "left",
                                none->reason);
          continue;
        }
        (is_right ? view.corners.right : view.corners.left) =
            std::get<std::vector<BoardCorner>>(std::move(sighting));
      } catch (const InputError& error) {
        for (const InputFault& fault : error.faults()) faults.AddFault(fault);
      }
    }
    if (reason.empty()) {
      views.push_back(std::move(view));
    } else {
      without_board.push_back({view.name, reason});
    }
  }
  faults.ThrowIfAny();
  if (views.empty() && !without_board.empty()) {
    throw InputError(
        "calibration",
        fmt::format("the board is in none of {} views; the first one, {}: {}", without_board.size(),
                    without_board.front().name, without_board.front().reason));
  }
  StereoCalibrationResult result = CalibrateStereo(
      views, board, {.left_size = size, .right_size = size, .adjustment = adjustment});
  CheckBaseline(result);
  result.left_out.insert(result.left_out.begin(), without_board.begin(), without_board.end());
  return result;
}

}  // namespace fenestra

#include "experiments/board_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "core/faults.h"
#include "core/image_io.h"
#include "vision/calibration/board_finder.h"

namespace fenestra {
namespace {

namespace fs = std::filesystem;

// Digits compare as numbers.
bool NaturallyLess(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  size_t i = 0;
  size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      size_t i_end = i;
      size_t j_end = j;
      while (i_end < a.size() && is_digit(a[i_end])) ++i_end;
      while (j_end < b.size() && is_digit(b[j_end])) ++j_end;
      std::string x = a.substr(i, i_end - i);
      std::string y = b.substr(j, j_end - j);
      x.erase(0, std::min(x.find_first_not_of('0'), x.size() - 1));
      y.erase(0, std::min(y.find_first_not_of('0'), y.size() - 1));
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      i = i_end;
      j = j_end;
      continue;
    }
    if (a[i] != b[j]) return a[i] < b[j];
    ++i;
    ++j;
  }
  return a.size() - i < b.size() - j;
}

// * stands for any run of characters, ? for one.
bool Matches(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern.front() == '*') {
    return Matches(pattern.substr(1), text) || (!text.empty() && Matches(pattern, text.substr(1)));
  }
  if (text.empty()) return false;
  return (pattern.front() == '?' || pattern.front() == text.front()) &&
         Matches(pattern.substr(1), text.substr(1));
}

bool IsImage(const fs::path& file) {
  static const std::set<std::string> endings = {".png", ".jpg",  ".jpeg", ".bmp",
                                                ".tif", ".tiff", ".pgm",  ".ppm"};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return endings.contains(ending);
}

std::vector<fs::path> FilesIn(const fs::path& folder, const std::string& pattern) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& file = entry.path();
    const bool wanted =
        pattern.empty() ? IsImage(file) : Matches(pattern, file.filename().string());
    if (wanted && entry.is_regular_file()) files.push_back(file);
  }
  return files;
}

// All runs of digits in a file's name, without leading zeros: what tells the pictures of a session
// apart. "left03" and "right3" have the same ones.
std::vector<std::string> NumbersIn(const fs::path& file) {
  std::vector<std::string> numbers;
  bool inside = false;
  for (const char c : file.stem().string()) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (digit && !inside) numbers.emplace_back();
    if (digit && numbers.back() == "0") numbers.back().clear();
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

// A baseline that is none, or that points to the wrong side.
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
}

cv::Mat1b ReadBoardPicture(const fs::path& file) {
  cv::Mat1b grey;
  cv::cvtColor(ReadColorImage(file), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

std::vector<fs::path> ImageFiles(const std::vector<std::string>& arguments) {
  std::vector<fs::path> files;
  for (const std::string& argument : arguments) {
    const fs::path path(argument);
    std::vector<fs::path> found;
    if (fs::is_directory(path)) {
      found = FilesIn(path, "");
      if (found.empty()) throw InputError(argument, "there are no images in this folder");
    } else if (argument.find_first_of("*?") != std::string::npos && !fs::exists(path)) {
      const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
      found = FilesIn(folder, path.filename().string());
      if (found.empty()) throw InputError(argument, "no file matches this pattern");
    } else if (fs::exists(path)) {
      found = {path};
    } else {
      throw InputError(argument, "there is no such file");
    }
    files.insert(files.end(), found.begin(), found.end());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    if (NaturallyLess(a.string(), b.string())) return true;
    // "view1" and "view01" are in some order, always the same.
    return !NaturallyLess(b.string(), a.string()) && a < b;
  });
  return files;
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
          throw InputError(file.string(),
                           fmt::format("{} x {} px, but the first picture has {} x {}",
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

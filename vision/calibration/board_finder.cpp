#include "vision/calibration/board_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/calibration/corner_refinement.h"

namespace fenestra {
namespace {

using Points = std::vector<cv::Point2f>;

// A corner before refinement.
using Corners = std::map<int, cv::Point2f>;

constexpr int kFewestCorners = 6;

// Mean grey value of the middle of the square with the given corners.
double Brightness(const cv::Mat1b& image, const std::array<cv::Point2f, 4>& square) {
  const cv::Point2f centre = 0.25f * (square[0] + square[1] + square[2] + square[3]);
  const double side = cv::norm(square[1] - square[0]);
  const int reach = std::max(1, static_cast<int>(0.2 * side));
  const cv::Rect window =
      cv::Rect(static_cast<int>(centre.x) - reach, static_cast<int>(centre.y) - reach,
               2 * reach + 1, 2 * reach + 1) &
      cv::Rect({0, 0}, image.size());
  return window.empty() ? 0.0 : cv::mean(image(window))[0];
}

// Tells whether the square whose top left corner is the first corner is white. It has the colour of
// the board's first square, which touches it diagonally, since their row and column numbers have an
// even sum. It is black unless the board is upside down.
bool IsUpsideDown(const cv::Mat1b& image, const Points& corners, const CalibrationBoard& board) {
  const auto columns = static_cast<size_t>(board.corner_columns());
  const auto rows = static_cast<size_t>(board.corner_rows());
  double even = 0.0;
  double odd = 0.0;
  int even_count = 0;
  int odd_count = 0;
  for (size_t row = 0; row + 1 < rows; ++row) {
    for (size_t column = 0; column + 1 < columns; ++column) {
      const size_t first = row * columns + column;
      const double grey =
          Brightness(image, {corners[first], corners[first + 1], corners[first + columns + 1],
                             corners[first + columns]});
      const bool is_even = (row + column) % 2 == 0;
      (is_even ? even : odd) += grey;
      ++(is_even ? even_count : odd_count);
    }
  }
  return even / even_count > odd / std::max(1, odd_count);
}

std::variant<Corners, BoardNotFound> FindChessboard(const cv::Mat1b& image,
                                                    const CalibrationBoard& board) {
  const cv::Size size(board.corner_columns(), board.corner_rows());
  Points found;
  constexpr int kFlags = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE;
  if (!cv::findChessboardCorners(image, size, found, kFlags)) {
    return BoardNotFound{fmt::format(
        "no chessboard of {} x {} inner corners, wholly in the image with a white margin",
        size.width, size.height)};
  }
  if (IsUpsideDown(image, found, board)) std::reverse(found.begin(), found.end());
  Corners corners;
  for (size_t i = 0; i < found.size(); ++i) corners[static_cast<int>(i)] = found[i];
  return corners;
}

std::variant<Corners, BoardNotFound> FindCharuco(const cv::Mat1b& image,
                                                 const CalibrationBoard& board) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_100);
  const auto layout =
      cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.square_m),
                                      static_cast<float>(board.marker_m), dictionary);
  std::vector<Points> markers;
  std::vector<int> marker_ids;
  cv::aruco::detectMarkers(image, dictionary, markers, marker_ids);
  if (marker_ids.empty()) return BoardNotFound{"none of the ChArUco board's markers"};
  Points found;
  std::vector<int> ids;
  cv::aruco::interpolateCornersCharuco(markers, marker_ids, image, layout, found, ids);
  if (static_cast<int>(ids.size()) < kFewestCorners) {
    return BoardNotFound{
        fmt::format("{} markers, but only {} of {} corners between them; {} are "
                    "needed",
                    marker_ids.size(), ids.size(), board.corner_count(), kFewestCorners)};
  }
  Corners corners;
  for (size_t i = 0; i < ids.size(); ++i) corners[ids[i]] = found[i];
  return corners;
}

// Homography from metres on the board's plane to pixels, ignoring the lens distortion.
cv::Matx33d BoardToImage(const Corners& corners, const CalibrationBoard& board) {
  Points on_board;
  Points in_image;
  for (const auto& [id, pixel] : corners) {
    const Eigen::Vector3d p_GQ = board.Corner(id);
    on_board.emplace_back(static_cast<float>(p_GQ.x()), static_cast<float>(p_GQ.y()));
    in_image.push_back(pixel);
  }
  return cv::findHomography(on_board, in_image);
}

Eigen::Vector2d Mapped(const cv::Matx33d& H, double x_m, double y_m) {
  const cv::Vec3d mapped = H * cv::Vec3d(x_m, y_m, 1.0);
  return {mapped[0] / mapped[2], mapped[1] / mapped[2]};
}

CornerGuess GuessOf(const cv::Matx33d& H, const CalibrationBoard& board, int id,
                    const cv::Point2f& start) {
  const Eigen::Vector3d p_GQ = board.Corner(id);
  const double half_m = 0.5 * board.square_m;
  const Eigen::Vector2d along_row =
      Mapped(H, p_GQ.x() + half_m, p_GQ.y()) - Mapped(H, p_GQ.x() - half_m, p_GQ.y());
  const Eigen::Vector2d along_column =
      Mapped(H, p_GQ.x(), p_GQ.y() + half_m) - Mapped(H, p_GQ.x(), p_GQ.y() - half_m);
  // Distance between opposite sides of the square.
  const double area = std::abs(along_row.x() * along_column.y() - along_row.y() * along_column.x());
  const double width_px = area / std::max(along_row.norm(), along_column.norm());
  // The radius stays clear of neighbouring corners or of the markers.
  double share = 0.4;
  if (board.kind == BoardKind::kCharuco) {
    share = std::min(share, 0.5 * (board.square_m - board.marker_m) / board.square_m);
  }
  constexpr double kSmallest_px = 2.5;
  constexpr double kLargest_px = 9.0;
  return {.pixel = {start.x, start.y},
          .along_row = along_row,
          .along_column = along_column,
          .radius_px = std::clamp(share * width_px, kSmallest_px, kLargest_px)};
}

}  // namespace

BoardSighting FindBoard(const cv::Mat1b& image, const CalibrationBoard& board) {
  const auto found = board.kind == BoardKind::kChessboard ? FindChessboard(image, board)
                                                          : FindCharuco(image, board);
  if (const auto* none = std::get_if<BoardNotFound>(&found)) return *none;
  const Corners& corners = std::get<Corners>(found);
  const cv::Matx33d H = BoardToImage(corners, board);
  std::vector<BoardCorner> refined;
  for (const auto& [id, start] : corners) {
    const auto pixel = RefineCorner(image, GuessOf(H, board, id, start));
    if (pixel) refined.push_back({.id = id, .pixel = *pixel});
  }
  if (static_cast<int>(refined.size()) < kFewestCorners) {
    return BoardNotFound{
        fmt::format("{} corners, but only {} of them are sharp enough to be located; {} are needed",
                    corners.size(), refined.size(), kFewestCorners)};
  }
  return refined;
}

}  // namespace fenestra

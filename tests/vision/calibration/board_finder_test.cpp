#include "vision/calibration/board_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/io/image_io.h"
#include "sim/stereo/board_session.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;

// Coma displaces corners by what the finder takes for even.
StereoRigOptions Noiseless() {
  StereoRigOptions options;
  options.sensor.noise = false;
  options.sensor.fixed_pattern = false;
  options.corner_coma_px = 0.0;
  return options;
}

struct CornerErrors {
  double rms_px = 0.0;  ///< Of a coordinate.
  double worst_px = 0.0;
  int corners = 0;
};

// Corners found in simulated pictures against where the true cameras project them.
CornerErrors ErrorsOf(const BoardSessionOptions& session, int views) {
  const BoardWorld world{BoardShape(session.board, kAsDrawn, RandomStream(0))};
  const StereoRig rig(Noiseless(), RandomStream(1));
  CornerErrors errors;
  double sum = 0.0;
  for (int i = 0; i < views; ++i) {
    const RandomStream view = RandomStream(7).Child("view", static_cast<uint64_t>(i));
    const StereoObservation seen = ShootBoard(rig, world, session, view);
    const Pose X_LG = TrueBoardPose(rig, session, view);
    for (const bool is_right : {false, true}) {
      const BoardSighting sighting = FindBoard(is_right ? seen.right : seen.left, session.board);
      const auto* corners = std::get_if<std::vector<BoardCorner>>(&sighting);
      if (corners == nullptr) continue;
      const CameraModel& camera = is_right ? rig.cameras().right : rig.cameras().left;
      const Pose X_CG = is_right ? rig.cameras().X_RL * X_LG : X_LG;
      for (const BoardCorner& corner : *corners) {
        const Eigen::Vector2d error =
            corner.pixel - *camera.Project(X_CG * session.board.Corner(corner.id));
        sum += error.squaredNorm();
        errors.worst_px = std::max(errors.worst_px, error.norm());
        ++errors.corners;
      }
    }
  }
  errors.rms_px = std::sqrt(0.5 * sum / errors.corners);
  return errors;
}

TEST(BoardFinderTest, CornersAreWhereTheTrueCamerasProjectThem) {
  // Squares of 25 px and more, tilts up to 30°.
  BoardSessionOptions session;
  session.smallest_share = 0.35;
  session.largest_tilt_rad = 0.5;
  const CornerErrors errors = ErrorsOf(session, 6);
  EXPECT_EQ(errors.corners, 2 * 6 * session.board.corner_count());
  EXPECT_LT(errors.rms_px, 0.006);
  EXPECT_LT(errors.worst_px, 0.03);
}

TEST(BoardFinderTest, CharucoCornersAreFoundToo) {
  BoardSessionOptions session;
  session.board.kind = BoardKind::kCharuco;
  session.smallest_share = 0.4;
  session.largest_tilt_rad = 0.5;
  const CornerErrors errors = ErrorsOf(session, 3);
  // Markers crowd the corners: their windows are small.
  EXPECT_GT(errors.corners, 2 * 3 * session.board.corner_count() / 2);
  EXPECT_LT(errors.rms_px, 0.03);
}

// A picture of the whole board, squarely from the front.
StereoObservation Front(const CalibrationBoard& board) {
  BoardSessionOptions session;
  session.board = board;
  session.largest_tilt_rad = 1e-3;
  session.smallest_share = 0.4;
  return ShootBoard(StereoRig(Noiseless(), RandomStream(1)),
                    BoardWorld(BoardShape(board, kAsDrawn, RandomStream(0))), session,
                    RandomStream(3));
}

TEST(BoardFinderTest, ABoardOnItsHeadIsReadFromItsOwnTopLeft) {
  const CalibrationBoard board;
  const cv::Mat1b upright = Front(board).left;
  cv::Mat1b turned;
  cv::rotate(upright, turned, cv::ROTATE_180);
  const auto a = std::get<std::vector<BoardCorner>>(FindBoard(upright, board));
  const auto b = std::get<std::vector<BoardCorner>>(FindBoard(turned, board));
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    const Eigen::Vector2d mirrored(upright.cols - 1 - b[i].pixel.x(),
                                   upright.rows - 1 - b[i].pixel.y());
    EXPECT_LT((a[i].pixel - mirrored).norm(), 1e-3);
  }
  // From the front the first corner is at the top left.
  EXPECT_LT(a.front().pixel.x(), a.back().pixel.x());
  EXPECT_LT(a.front().pixel.y(), a.back().pixel.y());
}

TEST(BoardFinderTest, ReasonsNameWhatWasLookedFor) {
  const CalibrationBoard board;
  const BoardSighting nothing = FindBoard(cv::Mat1b(480, 752, uchar{128}), board);
  EXPECT_THAT(std::get<BoardNotFound>(nothing).reason, HasSubstr("9 x 6 inner corners"));
  CalibrationBoard charuco = board;
  charuco.kind = BoardKind::kCharuco;
  const BoardSighting no_markers = FindBoard(Front(board).left, charuco);
  EXPECT_THAT(std::get<BoardNotFound>(no_markers).reason, HasSubstr("markers"));
}

TEST(BoardFinderTest, ARealBoardIsFound) {
  const cv::Mat1b picture =
      ReadGrayImage(FENESTRA_SOURCE_DIR "/tests/data/stereo-calibration/left01.jpg");
  const BoardSighting sighting = FindBoard(picture, {.square_m = 0.03});
  EXPECT_EQ(std::get<std::vector<BoardCorner>>(sighting).size(), 54u);
}

}  // namespace
}  // namespace fenestra

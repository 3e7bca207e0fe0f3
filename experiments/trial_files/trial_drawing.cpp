#include "experiments/trial_files/trial_drawing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/structured_light/explained_depth.h"

namespace fenestra {
namespace {

const cv::Scalar kTruthColor(60, 200, 60);
const cv::Scalar kOtherColor(200, 200, 60);
const cv::Scalar kEstimateColor(220, 60, 240);
constexpr int kFractionBits = 4;  // Lines are drawn to a sixteenth of a pixel.

class Pen {
 public:
  Pen(cv::Mat3b& image, const PictureView& view) : image_(image), view_(view) {}

  void Window(const std::array<Eigen::Vector3d, 4>& p_CV, const Eigen::Vector3d& p_CO,
              const cv::Scalar& color) const {
    for (size_t i = 0; i < 4; ++i) Segment(p_CV[i], p_CV[(i + 1) % 4], color);
    if (const auto center = view_.camera.Project(view_.X_PC * p_CO)) Cross(*center, color);
  }

 private:
  // Straight in the world; in a distorted image a chain of short pieces.
  void Segment(const Eigen::Vector3d& p_CA, const Eigen::Vector3d& p_CB,
               const cv::Scalar& color) const {
    constexpr int kPieces = 16;
    std::optional<Eigen::Vector2d> previous;
    for (int i = 0; i <= kPieces; ++i) {
      const double t = static_cast<double>(i) / kPieces;
      const auto pixel = view_.camera.Project(view_.X_PC * ((1.0 - t) * p_CA + t * p_CB));
      if (previous && pixel) Line(*previous, *pixel, color);
      previous = pixel;
    }
  }

  void Cross(const Eigen::Vector2d& center, const cv::Scalar& color) const {
    const Eigen::Vector2d reach(6.0, 0.0);
    Line(center - reach, center + reach, color);
    Line(center - reach.reverse(), center + reach.reverse(), color);
  }

  void Line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& color) const {
    // Far outside the picture fixed-point coordinates would overflow.
    if (a.cwiseAbs().maxCoeff() > 1e5 || b.cwiseAbs().maxCoeff() > 1e5) return;
    cv::line(image_, Fixed(a), Fixed(b), color, 1, cv::LINE_AA, kFractionBits);
  }

  static cv::Point Fixed(const Eigen::Vector2d& p) {
    constexpr double kUnit = 1 << kFractionBits;
    return {static_cast<int>(std::lround(kUnit * p.x())),
            static_cast<int>(std::lround(kUnit * p.y()))};
  }

  cv::Mat3b& image_;
  const PictureView& view_;
};

}  // namespace

cv::Mat3b DrawTruthAndEstimate(const cv::Mat& image, std::span<const PictureView> views,
                               const GroundTruth* truth, const WindowEstimate* estimate) {
  cv::Mat3b drawn;
  if (image.channels() == 1) {
    cv::cvtColor(image, drawn, cv::COLOR_GRAY2BGR);
  } else {
    drawn = image.clone();
  }
  for (const PictureView& view : views) {
    const Pen pen(drawn, view);
    if (truth != nullptr) {
      for (const WindowTruth& other : truth->other_windows) {
        pen.Window(other.p_CV, other.p_CO, kOtherColor);
      }
      if (truth->target) pen.Window(truth->target->p_CV, truth->target->p_CO, kTruthColor);
    }
    if (estimate != nullptr) pen.Window(estimate->p_CV, estimate->p_CO, kEstimateColor);
  }
  return drawn;
}

cv::Mat3b DrawDepth(const DepthImage& depth) {
  constexpr double kNearest_m = 0.4;
  constexpr double kFarthest_m = 6.0;
  cv::Mat1b scaled(depth.raw.size());
  for (int v = 0; v < scaled.rows; ++v) {
    for (int u = 0; u < scaled.cols; ++u) {
      const double z_m = depth.unit_m * depth.raw(v, u);
      // Inverse depth, as sensors resolve it.
      const double t = (1.0 / std::max(z_m, kNearest_m) - 1.0 / kFarthest_m) /
                       (1.0 / kNearest_m - 1.0 / kFarthest_m);
      scaled(v, u) = cv::saturate_cast<unsigned char>(255.0 * t);
    }
  }
  cv::Mat3b colored;
  cv::applyColorMap(scaled, colored, cv::COLORMAP_TURBO);
  colored.setTo(cv::Scalar::all(0), depth.raw == 0);
  return colored;
}

cv::Mat3b DrawNoReturn(const cv::Mat1b& no_return) {
  const auto color_of = [](NoReturn reason) -> cv::Vec3b {  // B, G, R.
    switch (reason) {
      case NoReturn::kNone:
        return {255, 255, 255};
      case NoReturn::kNoSurface:
        return {0, 0, 0};
      case NoReturn::kRange:
        return {128, 128, 128};
      case NoReturn::kShadow:
        return {178, 114, 0};  // Blue.
      case NoReturn::kGrazing:
        return {167, 121, 204};  // Pink.
      case NoReturn::kDark:
        return {0, 94, 213};  // Vermilion.
      case NoReturn::kSaturated:
        return {66, 228, 240};  // Yellow.
      case NoReturn::kNoMatch:
        return {115, 158, 0};  // Green.
      case NoReturn::kBorder:
        return {200, 200, 200};
      case NoReturn::kNotRegistered:
        return {233, 180, 86};  // Sky blue.
    }
    return {255, 0, 255};
  };
  cv::Mat3b picture(no_return.size());
  std::transform(no_return.begin(), no_return.end(), picture.begin(),
                 [&](unsigned char reason) { return color_of(static_cast<NoReturn>(reason)); });
  return picture;
}

std::array<PictureView, 2> ObservationViews(const SensorCalibration& calibration) {
  if (const auto* stereo = std::get_if<StereoCalibration>(&calibration)) {
    return {PictureView{stereo->left, Pose()}, PictureView{stereo->right, stereo->X_RL}};
  }
  const auto& rgbd = std::get<RgbdCalibration>(calibration);
  return {PictureView{rgbd.color, rgbd.X_KD}, PictureView{rgbd.depth, Pose()}};
}

}  // namespace fenestra

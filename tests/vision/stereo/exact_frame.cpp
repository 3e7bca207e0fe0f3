#include "tests/vision/stereo/exact_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra::testing {
namespace {

constexpr int kFine = 4;  // Parts of a pixel in each direction.

using Corners = std::array<Eigen::Vector2d, 4>;

// Exact coverage of a polygon by the signed areas right of its edges, summed along rows
// (R. Levien, "font-rs", 2015).
class AreaAccumulator {
 public:
  explicit AreaAccumulator(cv::Size size) : area_(size.height, size.width + 2, 0.0) {}

  void AddEdge(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    if (from.y() == to.y()) return;
    const double sign = from.y() < to.y() ? 1.0 : -1.0;
    const Eigen::Vector2d upper = sign > 0.0 ? from : to;
    const Eigen::Vector2d lower = sign > 0.0 ? to : from;
    const double slope = (lower.x() - upper.x()) / (lower.y() - upper.y());
    double x = upper.x();
    const int last = static_cast<int>(std::ceil(lower.y()));
    for (int row = static_cast<int>(std::floor(upper.y())); row < last; ++row) {
      const double dy = std::min(row + 1.0, lower.y()) - std::max<double>(row, upper.y());
      const double next = x + slope * dy;
      AddToRow(row, std::min(x, next), std::max(x, next), sign * dy);
      x = next;
    }
  }

  cv::Mat1d Coverage() const {
    cv::Mat1d coverage(area_.rows, area_.cols - 2);
    for (int v = 0; v < coverage.rows; ++v) {
      double sum = 0.0;
      for (int u = 0; u < coverage.cols; ++u) {
        sum += area_(v, u);
        coverage(v, u) = std::abs(sum);
      }
    }
    return coverage;
  }

 private:
  // An edge that crosses `height` of a row from x0 to x1: the covered share of each pixel, as
  // differences along the row.
  void AddToRow(int row, double x0, double x1, double height) {
    const int first = static_cast<int>(std::floor(x0));
    const int last = static_cast<int>(std::floor(x1));
    double before = 0.0;
    for (int u = first; u <= last + 1; ++u) {
      const double covered = height * ShareLeftOf(u + 1.0, x0, x1);
      area_(row, u) += covered - before;
      before = covered;
    }
    // From there on the whole height counts.
    area_(row, last + 2 < area_.cols ? last + 2 : last + 1) += height - before;
  }

  // Share of the pixel [x - 1, x] that is to the right of an edge spread evenly over [x0, x1].
  static double ShareLeftOf(double x, double x0, double x1) {
    const auto integral = [&](double t) {
      if (t <= x0) return 0.0;
      if (t >= x1) return t - 0.5 * (x0 + x1);
      return 0.5 * (t - x0) * (t - x0) / (x1 - x0);
    };
    return integral(x) - integral(x - 1.0);
  }

  cv::Mat1d area_;
};

cv::Mat1d Coverage(const CameraModel& camera, const Pose& X_CO, double width_m, double height_m) {
  Corners corners;
  for (size_t i = 0; i < 4; ++i) {
    const double x = (i == 1 || i == 2 ? 0.5 : -0.5) * width_m;
    const double y = (i < 2 ? 0.5 : -0.5) * height_m;
    // Pixel centres are whole numbers; borders of the fine grid are.
    corners[i] = kFine * (camera.Project(X_CO * Eigen::Vector3d(x, y, 0.0)).value() +
                          Eigen::Vector2d::Constant(0.5));
  }
  AreaAccumulator accumulator({kFine * camera.width_px(), kFine * camera.height_px()});
  for (size_t i = 0; i < 4; ++i) accumulator.AddEdge(corners[i], corners[(i + 1) % 4]);
  return accumulator.Coverage();
}

}  // namespace

cv::Mat1f ExactPicture(const CameraModel& camera, const Pose& X_CL, const ExactFrame& frame) {
  const Pose X_CO = X_CL * frame.X_LO;
  const cv::Mat1d outer = Coverage(camera, X_CO, frame.width_m, frame.height_m);
  const cv::Mat1d inner = Coverage(camera, X_CO, frame.width_m - 2.0 * frame.border_m,
                                   frame.height_m - 2.0 * frame.border_m);
  cv::Mat1d fine = frame.wall_dn + outer * (frame.frame_dn - frame.wall_dn) +
                   inner * (frame.opening_dn - frame.frame_dn);
  cv::GaussianBlur(fine, fine, {}, kFine * frame.blur_px);
  cv::Mat1d picture;
  cv::resize(fine, picture, {camera.width_px(), camera.height_px()}, 0.0, 0.0, cv::INTER_AREA);
  return picture;
}

StereoObservation WithNoise(const cv::Mat1f& left, const cv::Mat1f& right, double noise_dn,
                            const RandomStream& stream) {
  const auto expose = [&](const cv::Mat1f& picture, uint64_t camera) {
    cv::Mat1f noise(picture.size());
    stream.Child("noise", camera).FillNormals({noise.ptr<float>(), noise.total()});
    cv::Mat1b exposed;
    cv::Mat1f(picture + noise_dn * noise).convertTo(exposed, CV_8U);
    return exposed;
  };
  return {expose(left, 0), expose(right, 1)};
}

StereoObservation ExactPair(const StereoCalibration& rig, const ExactFrame& frame, double noise_dn,
                            const RandomStream& stream) {
  return WithNoise(ExactPicture(rig.left, Pose(), frame), ExactPicture(rig.right, rig.X_RL, frame),
                   noise_dn, stream);
}

}  // namespace fenestra::testing

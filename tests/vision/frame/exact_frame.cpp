#include "tests/vision/frame/exact_frame.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace fenestra::testing {
namespace {

constexpr int kFine = 4;  // Parts of a pixel in each direction.

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

using Polygon = std::vector<Eigen::Vector2d>;

// On the fine grid: pixel centres are whole numbers; borders of the fine grid are.
Polygon Outline(const CameraModel& camera, const Pose& X_CO, const Eigen::Vector2d& size_m,
                double z_m) {
  Polygon corners;
  for (size_t i = 0; i < 4; ++i) {
    const double x = (i == 1 || i == 2 ? 0.5 : -0.5) * size_m.x();
    const double y = (i < 2 ? 0.5 : -0.5) * size_m.y();
    corners.push_back(kFine * (camera.Project(X_CO * Eigen::Vector3d(x, y, z_m)).value() +
                               Eigen::Vector2d::Constant(0.5)));
  }
  return corners;
}

// What two convex polygons, clockwise as seen, have in common (Sutherland and Hodgman).
Polygon Common(Polygon polygon, const Polygon& window) {
  for (size_t i = 0; i < window.size(); ++i) {
    const Eigen::Vector2d a = window[i];
    const Eigen::Vector2d along = window[(i + 1) % window.size()] - a;
    const auto inside = [&](const Eigen::Vector2d& p) {
      return along.x() * (p.y() - a.y()) - along.y() * (p.x() - a.x());
    };
    Polygon clipped;
    for (size_t j = 0; j < polygon.size(); ++j) {
      const Eigen::Vector2d& p = polygon[j];
      const Eigen::Vector2d& q = polygon[(j + 1) % polygon.size()];
      const double at_p = inside(p);
      const double at_q = inside(q);
      if (at_p >= 0.0) clipped.push_back(p);
      if ((at_p >= 0.0) != (at_q >= 0.0)) clipped.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    polygon = clipped;
  }
  return polygon;
}

cv::Mat1d Coverage(const CameraModel& camera, const Polygon& polygon) {
  AreaAccumulator accumulator({kFine * camera.width_px(), kFine * camera.height_px()});
  for (size_t i = 0; i < polygon.size(); ++i) {
    accumulator.AddEdge(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return accumulator.Coverage();
}

}  // namespace

cv::Mat1f ExactPicture(const CameraModel& camera, const Pose& X_CL, const ExactFrame& frame) {
  const Pose X_CO = X_CL * frame.X_LO;
  const Eigen::Vector2d size_m(frame.width_m, frame.height_m);
  const Eigen::Vector2d opening_m = size_m - Eigen::Vector2d::Constant(2.0 * frame.border_m);
  const Polygon wall = Outline(camera, X_CO, size_m, frame.setback_m);
  const Polygon outer = Common(Outline(camera, X_CO, size_m, 0.0), wall);
  const Polygon inner = Common(Outline(camera, X_CO, opening_m, 0.0), wall);
  cv::Mat1d fine = frame.wall_dn + Coverage(camera, wall) * (frame.reveal_dn - frame.wall_dn) +
                   Coverage(camera, outer) * (frame.frame_dn - frame.reveal_dn) +
                   Coverage(camera, inner) * (frame.opening_dn - frame.frame_dn);
  cv::GaussianBlur(fine, fine, {}, kFine * frame.blur_px);
  cv::Mat1d picture;
  cv::resize(fine, picture, {camera.width_px(), camera.height_px()}, 0.0, 0.0, cv::INTER_AREA);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const double inverse_cos = camera.UnprojectRay({u, v}).value().norm();
      const double light = std::pow(inverse_cos, -frame.vignetting_power);
      picture(v, u) = frame.black_dn + light * (picture(v, u) - frame.black_dn);
    }
  }
  return picture;
}

cv::Mat1f WithUnevenLight(const cv::Mat1f& picture, const CameraModel& camera, const Pose& X_CL,
                          const ExactFrame& frame, const std::array<double, 4>& slopes_per_px) {
  const Pose X_OC = (X_CL * frame.X_LO).inverse();
  const double px_per_m = camera.parameters().fx_px / (X_CL * frame.X_LO).translation().z();
  cv::Mat1f uneven = picture.clone();
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const Eigen::Vector3d ray_O = X_OC.rotation() * camera.UnprojectRay({u, v}).value();
      const Eigen::Vector3d p_O = X_OC.translation() - X_OC.translation().z() / ray_O.z() * ray_O;
      const double right_m = std::abs(p_O.x()) - 0.5 * frame.width_m;
      const double up_m = std::abs(p_O.y()) - 0.5 * frame.height_m;
      const size_t side = up_m > right_m ? (p_O.y() > 0.0 ? 0 : 2) : (p_O.x() > 0.0 ? 1 : 3);
      const double outside_px = px_per_m * std::max({0.0, right_m, up_m});
      uneven(v, u) +=
          static_cast<float>(slopes_per_px[side] * outside_px * (picture(v, u) - frame.black_dn));
    }
  }
  return uneven;
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

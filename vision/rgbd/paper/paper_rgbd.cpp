#include "vision/rgbd/paper/paper_rgbd.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/io/input_error.h"
#include "vision/rgbd/paper/dark_cloud.h"
#include "vision/rgbd/paper/depth_registration.h"
#include "vision/rgbd/paper/diagonals.h"
#include "vision/rgbd/paper/frame_vertices.h"
#include "vision/rgbd/paper/narf_key_points.h"
#include "vision/rgbd/rgbd_images.h"

namespace fenestra {
namespace {

// The random samples of planes are part of the detector and equal for every observation.
constexpr uint64_t kPlaneSeed = 1;

RgbdCalibration Checked(const RgbdCalibration& calibration) {
  CheckDepthUnit(calibration);
  const CameraModel working = WorkingCamera(calibration);
  if (!NarfRangeImage::Supports(working)) {
    throw InputError(
        "color", fmt::format("a horizontal field of {:.1f} deg; NARF's planar range "
                             "image needs less than 90 deg",
                             2.0 * 180.0 / M_PI *
                                 std::atan(0.5 * working.width_px() / working.parameters().fx_px)));
  }
  return calibration;
}

// Most parts of a cloud that are searched separately; each costs a run of NARF.
constexpr size_t kMostParts = 8;
// Key points lie up to this share of a side inside its ends.
constexpr double kSideShare = 0.25;

FourVertices VerticesOf(const std::vector<KeyPoint>& key_points, const std::array<int, 4>& chosen) {
  FourVertices p_KV;
  for (size_t i = 0; i < 4; ++i) p_KV[i] = key_points[static_cast<size_t>(chosen[i])].p_KQ;
  return p_KV;
}

std::vector<Eigen::Vector3f> CloudInDepthFrame(const DarkCloud& cloud, const Pose& X_DK) {
  std::vector<Eigen::Vector3f> points_D;
  for (const Eigen::Vector3d& p_KQ : cloud.points_K) {
    points_D.push_back((X_DK * p_KQ).cast<float>());
  }
  return points_D;
}

std::optional<Miss> CloudFault(const DarkCloud& cloud, const PaperRgbdOptions& options) {
  if (cloud.dark_pixels == 0) {
    return Miss{"no_dark_pixels",
                options.prior.knows_color()
                    ? "no pixel has the expected colour"
                    : fmt::format("no pixel is below {} in all channels", options.dark_below_dn)};
  }
  const std::string counts = fmt::format("{} dark pixels, {} of them with depth", cloud.dark_pixels,
                                         cloud.points_K.size());
  if (cloud.points_K.empty()) return Miss{"no_depth_on_dark_pixels", counts};
  if (static_cast<int>(cloud.points_K.size()) < options.min_cloud_points) {
    return Miss{"cloud_too_small",
                fmt::format("{}; {} are needed", counts, options.min_cloud_points)};
  }
  return std::nullopt;
}

// Ends the running stage when Detect returns or throws.
class StageEnd {
 public:
  explicit StageEnd(StageLog& log) : log_(log) {}
  ~StageEnd() { log_.End(); }
  StageEnd(const StageEnd&) = delete;
  StageEnd& operator=(const StageEnd&) = delete;

 private:
  StageLog& log_;
};

// Scale of DrawKeyPoints' picture relative to the range image.
constexpr int kKeyPointPictureScale = 3;

// Marks in the colour image the cloud's pixels green and dark pixels without depth red.
cv::Mat3b DrawSegmentation(const RegisteredImages& images, const DarkCloud& cloud) {
  cv::Mat3b drawn = images.color.clone();
  const cv::Mat1b with_depth = cloud.depth_m > 0.0f;
  drawn.setTo(cv::Scalar(60, 60, 230), cloud.mask);
  drawn.setTo(cv::Scalar(80, 200, 80), with_depth);
  return drawn;
}

// Draws key points as circles on the cloud's depth, and the chosen four as a closed outline.
cv::Mat3b DrawKeyPoints(const cv::Mat1f& depth_m, const std::vector<KeyPoint>& key_points,
                        const std::optional<std::array<int, 4>>& chosen) {
  constexpr int kScale = kKeyPointPictureScale;
  cv::Mat3b drawn;
  cv::resize(DrawDepth(depth_m), drawn, {}, kScale, kScale, cv::INTER_NEAREST);
  const auto center = [](const KeyPoint& key_point) {
    return cv::Point(kScale * key_point.pixel.x() + kScale / 2,
                     kScale * key_point.pixel.y() + kScale / 2);
  };
  for (const KeyPoint& key_point : key_points) {
    cv::circle(drawn, center(key_point), 7, cv::Scalar(255, 255, 255), 2, cv::LINE_AA);
  }
  if (!chosen) return drawn;
  std::vector<cv::Point> outline;
  for (const int i : *chosen) outline.push_back(center(key_points[static_cast<size_t>(i)]));
  cv::polylines(drawn, outline, true, cv::Scalar(255, 0, 255), 2, cv::LINE_AA);
  return drawn;
}

}  // namespace

PlaneTolerance ToleranceOf(const PaperRgbdOptions& options) {
  return {.fixed_m = options.plane_tolerance_m, .per_z2 = options.plane_tolerance_per_m};
}

int RangeImageStride(const CameraModel& camera, const PaperRgbdOptions& options) {
  return (camera.width_px() + options.max_range_image_width_px - 1) /
         options.max_range_image_width_px;
}

double SupportSize(const CloudShape& shape, const CameraModel& camera,
                   const PaperRgbdOptions& options) {
  if (options.support_size_m > 0.0) return options.support_size_m;
  const double px_per_m =
      camera.parameters().fx_px / (RangeImageStride(camera, options) * shape.median_depth_m);
  return std::min(options.support_fraction * std::sqrt(shape.hull_area_m2),
                  options.max_support_px / px_per_m);
}

PaperRgbdDetector::PaperRgbdDetector(const RgbdCalibration& calibration,
                                     const PaperRgbdOptions& options)
    : calibration_(Checked(calibration)), options_(options), registration_(calibration) {
  Validate(options_);
}

Detection PaperRgbdDetector::Detect(const Observation& observation, StageLog& log) const {
  const RgbdObservation& images = RgbdPart(observation);
  const PictureView view{registration_.working_camera(), calibration_.X_KD};
  const StageEnd stage_end(log);
  log.Begin("register");
  const RegisteredImages registered = registration_.Register(images);
  log.Picture("registered_depth", [&] { return DrawDepth(registered.depth_m); }, {view});

  log.Begin("segment");
  const DarkCloud cloud = Segment(registered);
  log.Picture("segmentation", [&] { return DrawSegmentation(registered, cloud); }, {view});
  log.Cloud("cloud", [&] { return CloudInDepthFrame(cloud, calibration_.X_KD.inverse()); });
  if (const auto fault = CloudFault(cloud, options_)) return *fault;
  const std::vector<DarkCloud> parts = Split(cloud);
  if (parts.empty()) return Miss{"cloud_too_small", "no connected part has enough points"};
  std::vector<WindowEstimate> found;
  std::optional<Miss> first_miss;
  for (const DarkCloud& part : parts) {
    const Detection one = FindFrame(part, log, found.empty() && !first_miss);
    if (const auto* estimate = std::get_if<WindowEstimate>(&one)) {
      found.push_back(*estimate);
    } else if (!first_miss) {
      first_miss = std::get<Miss>(one);
    }
  }
  if (found.empty()) return *first_miss;
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return *a.score > *b.score; });
  WindowEstimate best = found.front();
  best.others.assign(found.begin() + 1, found.end());
  return best;
}

DarkCloud PaperRgbdDetector::Segment(const RegisteredImages& registered) const {
  const CameraModel& camera = registration_.working_camera();
  return options_.prior.knows_color()
             ? CloudOf(ExpectedColor(options_.prior, registered.color), registered.depth_m, camera)
             : SegmentDark(registered, camera, options_.dark_below_dn);
}

std::vector<DarkCloud> PaperRgbdDetector::Split(const DarkCloud& cloud) const {
  if (options_.cloud == "all") return {cloud};
  return ConnectedParts(cloud, registration_.working_camera(), options_.min_cloud_points,
                        options_.cloud == "largest_component" ? 1 : kMostParts);
}

Detection PaperRgbdDetector::FindFrame(const DarkCloud& cloud, StageLog& log,
                                       bool with_pictures) const {
  log.Begin("range_image");
  const PlaneTolerance tolerance = ToleranceOf(options_);
  const auto shape = ShapeOf(cloud.points_K, tolerance, RandomStream(kPlaneSeed));
  if (!shape) return Miss{"no_plane", "the dark points do not span a plane"};
  const CameraModel& camera = registration_.working_camera();
  const int stride = RangeImageStride(camera, options_);
  const NarfRangeImage range_image(cloud.depth_m, camera, stride, options_.unseen_is_far);

  log.Begin("narf");
  const double support_m = SupportSize(*shape, camera, options_);
  const std::vector<KeyPoint> key_points = range_image.DetectKeyPoints(
      {.support_size_m = support_m, .min_interest_value = options_.min_interest_value});

  log.Begin("vertices");
  const FrameVertices vertices = ChooseFrameVertices(
      key_points, *shape, tolerance,
      {.min_area_fraction = options_.min_area_fraction, .min_side_ratio = options_.min_side_ratio});
  if (with_pictures) {
    log.Picture("range_image",
                [&] { return DrawKeyPoints(cloud.depth_m, key_points, vertices.chosen); },
                {{camera.Scaled(kKeyPointPictureScale), calibration_.X_KD}});
  }
  if (vertices.miss) return *vertices.miss;

  log.Begin("centroid");
  return Estimate(cloud, *shape, VerticesOf(key_points, *vertices.chosen), vertices.area_fraction,
                  support_m);
}

Detection PaperRgbdDetector::Estimate(const DarkCloud& cloud, const CloudShape& shape,
                                      const FourVertices& p_KV, double area_fraction,
                                      double support_m) const {
  const auto crossing = CrossDiagonals(p_KV);
  if (!crossing) return Miss{"not_a_quadrilateral", "the diagonals do not cross"};
  const double filled =
      FilledShare(cloud, registration_.working_camera(), shape.plane, ToleranceOf(options_), p_KV);
  if (filled > options_.max_filled_share) {
    return Miss{"not_open", fmt::format("{:.2f} of the middle are dark and on the plane; {:.2f} "
                                        "are allowed",
                                        filled, options_.max_filled_share)};
  }
  const double seen =
      SeenShare(cloud, registration_.working_camera(), shape.plane, ToleranceOf(options_), p_KV);
  if (seen < options_.min_seen_share) {
    return Miss{"no_frame", fmt::format("{:.2f} of a side are dark and on the plane; {:.2f} are "
                                        "needed",
                                        seen, options_.min_seen_share)};
  }
  const double depth_m = crossing->p_CO.z();
  const Eigen::Matrix3d covariance_K = CrossingCovariance(
      p_KV, shape.plane,
      {.expected_m = options_.key_point_sigma_share * support_m,
       .expected_weight = options_.key_point_sigma_weight,
       .across_m = shape.scatter_m,
       .common_m = options_.depth_step_per_m * depth_m * depth_m / std::sqrt(12.0)});
  const Pose X_DK = calibration_.X_KD.inverse();
  FourVertices p_DV;
  for (size_t i = 0; i < 4; ++i) p_DV[i] = X_DK * p_KV[i];
  const WindowEstimate estimate{
      .p_CO = X_DK * crossing->p_CO,
      .p_CV = OrderedAsSeen(p_DV),
      .normal_C = X_DK.rotation() * shape.plane.normal_K,
      .covariance_C = X_DK.rotation() * covariance_K * X_DK.rotation().transpose(),
      .score = std::min(1.0, area_fraction) * shape.inlier_share * seen * (1.0 - filled)};
  if (auto objection = ObjectionOf(options_.prior, estimate, kSideShare)) return *objection;
  return estimate;
}

}  // namespace fenestra

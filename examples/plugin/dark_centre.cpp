// The whole of a detector in a shared library: the middle of what is dark in the colour image, at
// the depth of what surrounds it. It shows how a detector is written; as one it is simple.

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/io/input_error.h"
#include "vision/detector_plugin.h"

namespace {

using namespace fenestra;

struct DarkCentreOptions {
  int threshold_dn = 60;  // The painted frame reflects 4 %, the wall 60 %: between the two.
};

// The name, range and meaning of each option, as `fenestra list detectors` shows them.
const ParameterTable<DarkCentreOptions>& Parameters() {
  static const ParameterTable<DarkCentreOptions> table = [] {
    ParameterTable<DarkCentreOptions> t;
    t.Integer("threshold_dn", FENESTRA_FIELD(threshold_dn), {0, 255},
              "Darker pixels, in all three channels, belong to the frame");
    return t;
  }();
  return table;
}

class DarkCentre : public Detector {
 public:
  DarkCentre(const RgbdCalibration& calibration, const DarkCentreOptions& options)
      : calibration_(calibration), options_(options) {}

  SensorKind sensor() const override { return SensorKind::kRgbd; }

  Detection Detect(const Observation& observation, StageLog& log) const override {
    const auto* rgbd = std::get_if<RgbdObservation>(&observation);
    if (rgbd == nullptr) throw InputError("observation", "is not of an RGB-D sensor");
    log.Begin("threshold");
    const double most = options_.threshold_dn;
    cv::Mat1b dark;
    cv::inRange(rgbd->color, cv::Scalar::all(0.0), cv::Scalar::all(most), dark);
    log.Picture("dark", [&dark] { return dark; });
    const cv::Rect box = BoxOf(dark);
    if (box.area() < kLeastPixels) {
      return Miss{"nothing_dark", std::to_string(box.area()) + " pixels around what is dark"};
    }
    log.Begin("depth");
    const double z_m = WallDepth_m(rgbd->depth);
    if (z_m == 0.0) return Miss{"no_depth", "no pixel of the depth image returns"};
    return WindowAt(box, z_m);
  }

 private:
  static constexpr int kLeastPixels = 400;

  static cv::Rect BoxOf(const cv::Mat1b& dark) {
    std::vector<cv::Point> points;
    cv::findNonZero(dark, points);
    if (points.empty()) return {};
    cv::Point low = points.front(), high = points.front();
    for (const cv::Point& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    return {low, high + cv::Point(1, 1)};
  }

  // The median of what returns: for a camera that faces the wall.
  static double WallDepth_m(const DepthImage& depth) {
    std::vector<uint16_t> returns;
    for (const uint16_t raw : depth.raw) {
      if (raw != 0) returns.push_back(raw);
    }
    if (returns.empty()) return 0.0;
    const auto middle = returns.begin() + static_cast<ptrdiff_t>(returns.size() / 2);
    std::nth_element(returns.begin(), middle, returns.end());
    return *middle * depth.unit_m;
  }

  // The box's corners on the plane z = z_m, from the colour camera's frame K to the scored one's.
  Detection WindowAt(const cv::Rect& box, double z_m) const {
    const std::vector<Eigen::Vector2d> pixels = {
        {box.x - 0.5, box.y - 0.5},
        {box.x + box.width - 0.5, box.y - 0.5},
        {box.x + box.width - 0.5, box.y + box.height - 0.5},
        {box.x - 0.5, box.y + box.height - 0.5}};
    WindowEstimate estimate;
    for (size_t i = 0; i < 4; ++i) {
      const auto ray_K = calibration_.color.UnprojectRay(pixels[i]);
      if (!ray_K) return Miss{"outside_the_lens", "a corner has no ray"};
      estimate.p_CV[i] = calibration_.X_KD.inverse() * Eigen::Vector3d(*ray_K * z_m);
      estimate.p_CO += 0.25 * estimate.p_CV[i];
    }
    return estimate;
  }

  RgbdCalibration calibration_;
  DarkCentreOptions options_;
};

void Register(DetectorRegistrar& registrar) {
  registrar.Add({.name = "dark-centre",
                 .sensor = SensorKind::kRgbd,
                 .description = "The middle of what is dark, at the wall's depth",
                 .options = Parameters().infos()},
                FactoryFor<DarkCentre, RgbdCalibration>(Parameters()));
}

}  // namespace

FENESTRA_DETECTOR_PLUGIN(Register)

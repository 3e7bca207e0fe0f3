#include "sim/structured_light/structured_light_sensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/io/faults.h"

namespace fenestra {
namespace {

constexpr double kImageRate_hz = 30.0;

// The calibration of the images that are delivered.
RgbdCalibration Delivered(const RgbdCalibration& cameras, const StructuredLightOptions& o) {
  if (!o.registered_depth) return cameras;
  const double scale = static_cast<double>(o.depth_width_px) / o.color.width_px;
  return {.color = cameras.color, .depth = cameras.color.Scaled(scale), .X_KD = Pose()};
}

ColorCamera MakeColorCamera(const StructuredLightOptions& o, const RgbdCalibration& cameras,
                            const RandomStream& pixels) {
  return ColorCamera(o.color, cameras.color, cameras.X_KD.inverse(), o.motion,
                     o.edge_samples_per_pixel, pixels);
}

// The largest disparity that is searched [px of the infra-red image].
double MatchingSearchEnd(const StructuredLightOptions& o) {
  return o.matching.SearchEnd(RangeOf(o)) * o.infrared_width_px / DisparityRange::kImageWidth;
}

RollingShutter InfraredShutter(const StructuredLightOptions& o) {
  return {.motion = o.motion, .readout_s = o.infrared_readout_s};
}

std::variant<std::shared_ptr<const ParametricDepth>, std::shared_ptr<const MatchedDepth>>
MakeDepthModel(const StructuredLightOptions& o, const CameraModel& depth) {
  if (o.depth_model == DepthModel::kMatched) {
    return std::make_shared<const MatchedDepth>(
        o.infrared, o.matching, depth, o.infrared_width_px / o.depth_width_px,
        o.projector_baseline_m, RangeOf(o), InfraredShutter(o));
  }
  return std::make_shared<const ParametricDepth>(o.infrared, o.parametric, o.matching, depth,
                                                 o.projector_baseline_m, RangeOf(o),
                                                 InfraredShutter(o));
}

}  // namespace

RgbdCalibration DesignOf(const StructuredLightOptions& o) {
  return {.color = DesignOf(o.color),
          .depth = CameraModel::Pinhole(o.depth_width_px, o.depth_height_px, o.depth_focal_px),
          .X_KD = Pose::Translation({-o.color_offset_m, 0.0, 0.0})};
}

DisparityRange RangeOf(const StructuredLightOptions& o) {
  DisparityRange range = DisparityRange::Of(o.depth_focal_px, o.depth_width_px,
                                            o.projector_baseline_m, o.driver, o.near_mode);
  if (!o.quantised) range.step_px = 0.0;
  return range;
}

void Validate(const StructuredLightOptions& o) {
  Faults faults("structured-light sensor");
  faults.Require(o.projector_baseline_m > 0.0, "the projector's baseline must be positive");
  faults.Require(!o.near_mode || o.driver == DepthDriver::kMicrosoft,
                 "only Microsoft's driver has a near mode");
  faults.Require(o.averaged_frames >= 1 && o.averaged_frames <= 1000,
                 fmt::format("{} averaged frames are not between 1 and 1000", o.averaged_frames));
  faults.Require(
      !o.registered_depth ||
          o.depth_width_px * o.color.height_px == o.depth_height_px * o.color.width_px,
      fmt::format("depth in {} x {} px cannot be registered to colour in {} x {} px: the images "
                  "must have the same proportions",
                  o.depth_width_px, o.depth_height_px, o.color.width_px, o.color.height_px));
  faults.Require(
      o.depth_model != DepthModel::kMatched || o.infrared_width_px % o.depth_width_px == 0,
      fmt::format("an infra-red image {} px wide is not a multiple of the depth image's {} px",
                  o.infrared_width_px, o.depth_width_px));
  if (o.depth_model == DepthModel::kMatched && o.projector_baseline_m > 0.0) {
    const double end_px = MatchingSearchEnd(o);
    faults.Require(
        end_px <= PatternMatcher::kMostDisparity_px,
        fmt::format("at the nearest distance disparities are {:.0f} px of the infra-red image, "
                    "which is more than {:.0f}: it is too wide, or the focal length or the "
                    "projector's baseline too long",
                    end_px, PatternMatcher::kMostDisparity_px));
  }
  faults.RequireWithin("the delay of the colour image", o.color_delay_s, -1.0, 1.0);
  faults.ThrowIfAny();
  Validate(InfraredShutter(o));
  Validate(o.infrared);
  Validate(o.parametric);
  Validate(o.matching);
  Validate(o.color);
}

StructuredLightSensor::StructuredLightSensor(const StructuredLightOptions& options)
    : options_(Validated(options)),
      nominal_(Delivered(DesignOf(options), options)),
      unit_{.cameras = DesignOf(options), .disparity = {}, .deviations = {}},
      cameras_(nominal_),
      depth_model_(MakeDepthModel(options, unit_.cameras.depth)),
      color_(MakeColorCamera(options, unit_.cameras, RandomStream(0).Child("color_camera"))) {
  if (options.registered_depth) {
    const RgbdCalibration& known = unit_.cameras;
    registrar_.emplace(known.depth, known.X_KD, nominal_.depth);
  }
}

StructuredLightSensor StructuredLightSensor::Unit(const UnitDeviations& deviations,
                                                  const RandomStream& unit) const {
  StructuredLightSensor built = *this;
  if (deviations == UnitDeviations{}) return built;
  built.unit_ = BuildUnit(DesignOf(options_), deviations, unit);
  const RgbdCalibration& cameras = built.unit_.cameras;
  built.cameras_ = Delivered(cameras, options_);
  std::visit(
      [&](auto& model) {
        using Model = typename std::decay_t<decltype(model)>::element_type;
        model = std::make_shared<Model>(model->WithUnit(cameras.depth, built.unit_.disparity));
      },
      built.depth_model_);
  built.color_ = MakeColorCamera(options_, cameras, unit.Child("color_pixels"));
  return built;
}

const InfraredResponse& StructuredLightSensor::infrared_response() const {
  return std::visit([](const auto& model) -> const InfraredResponse& { return model->response(); },
                    depth_model_);
}

Pose StructuredLightSensor::X_WK(const Pose& X_WB) const {
  return X_WB * unit_.cameras.X_KD.inverse();
}

Pose StructuredLightSensor::X_WD(const Pose& X_WB) const {
  return options_.registered_depth ? X_WK(X_WB) : X_WB;
}

RgbdObservation StructuredLightSensor::Observe(const RayCaster& caster, const Lighting& lighting,
                                               const Pose& X_WB, const RandomStream& shot) const {
  return {.color = color_.Observe(caster, lighting,
                                  PoseAt(X_WB, options_.motion, options_.color_delay_s), shot),
          .depth = ObserveDepth(caster, lighting, X_WB, shot).depth};
}

ExplainedDepth StructuredLightSensor::ObserveDepth(const RayCaster& caster,
                                                   const Lighting& lighting, const Pose& X_WB,
                                                   const RandomStream& shot) const {
  const ExplainedDepth depth = AverageDepth(caster, lighting, X_WB, shot);
  return registrar_ ? registrar_->Register(depth, caster, lighting, X_WK(X_WB)) : depth;
}

ExplainedDepth StructuredLightSensor::AverageDepth(const RayCaster& caster,
                                                   const Lighting& lighting, const Pose& X_WB,
                                                   const RandomStream& shot) const {
  ExplainedDepth first = OneImage(caster, lighting, X_WB, shot, shot);
  if (options_.averaged_frames == 1) return first;
  cv::Mat1d sum;
  first.depth.raw.convertTo(sum, CV_64F);
  cv::Mat1d returns = cv::Mat1d::zeros(sum.size());
  returns.setTo(1.0, first.depth.raw != 0);
  for (int i = 1; i < options_.averaged_frames; ++i) {
    const RandomStream image_noise = shot.Child("frame", static_cast<uint64_t>(i));
    const Pose X_WBi = PoseAt(X_WB, options_.motion, -i / kImageRate_hz);
    // From another pose the laser's speckle is different.
    const RandomStream& view = options_.motion.still() ? shot : image_noise;
    const ExplainedDepth next = OneImage(caster, lighting, X_WBi, view, image_noise);
    cv::add(sum, next.depth.raw, sum, cv::noArray(), CV_64F);
    cv::add(returns, 1.0, returns, next.depth.raw != 0);
    // The reason of a hole is that of the first image with a hole there.
    next.no_return.copyTo(first.no_return, first.no_return == 0);
  }
  const cv::Mat1b counts = returns >= 0.5 * options_.averaged_frames;
  first.depth.raw.setTo(0);
  cv::Mat1w(cv::Mat(sum / returns)).copyTo(first.depth.raw, counts);
  first.no_return.setTo(0, counts);
  return first;
}

ExplainedDepth StructuredLightSensor::OneImage(const RayCaster& caster, const Lighting& lighting,
                                               const Pose& X_WB, const RandomStream& shot,
                                               const RandomStream& image_noise) const {
  return std::visit(
      [&](const auto& model) {
        return model->Observe(caster, lighting, X_WB, nominal_.depth_unit_m, shot, image_noise);
      },
      depth_model_);
}

GroundTruth StructuredLightSensor::Truth(const Scene& scene, const Pose& X_WB) const {
  const std::array<PlacedCamera, 2> cameras = {PlacedCamera{cameras_.depth, X_WD(X_WB)},
                                               PlacedCamera{cameras_.color, X_WK(X_WB)}};
  return MakeGroundTruth(scene, X_WD(X_WB), cameras);
}

TruthImages StructuredLightSensor::PixelTruth(const RayCaster& caster, const Lighting& lighting,
                                              const Pose& X_WB) const {
  const Eigen::Vector3d p_WP = X_WB * Eigen::Vector3d(options_.projector_baseline_m, 0.0, 0.0);
  const RayGrid rays(cameras_.depth);
  AovImages aovs = caster.CastAovs(rays, X_WD(X_WB), lighting, {.offsets_px = {}, .p_WP = p_WP});
  const RenderOptions render{.band = Band::kInfrared,
                             .edge_samples_per_pixel = options_.edge_samples_per_pixel};
  const cv::Mat1f radiance = caster.Render(rays, X_WD(X_WB), lighting, render, RandomStream(0));
  const auto fb =
      static_cast<float>(options_.depth_focal_px * options_.projector_baseline_m);  // [px m]
  cv::Mat2f disparity_px(aovs.depth_m.size());
  std::transform(aovs.depth_m.begin(), aovs.depth_m.end(), disparity_px.begin(),
                 [fb](float z_m) { return cv::Vec2f(fb / z_m, 0.0f * z_m); });
  return {.camera = cameras_.depth,
          .X_WC = X_WD(X_WB),
          .aovs = std::move(aovs),
          .band = render.band,
          .radiance = radiance,
          .disparity_px = std::move(disparity_px)};
}

}  // namespace fenestra

#pragma once

#include <opencv2/core.hpp>

#include "core/detection/depth_reprojection.h"
#include "core/detection/observation.h"
#include "core/geometry/camera_model.h"
#include "renderers/ray_caster.h"
#include "renderers/tracing/render_types.h"
#include "sim/structured_light/disparity.h"
#include "sim/structured_light/infrared_response.h"
#include "sim/structured_light/pattern_matching.h"

namespace fenestra {

/// Reason why a depth pixel has no return. It is part of the truth; detectors never see it.
enum class NoReturn : unsigned char {
  kNone = 0,  ///< There is a return.
  kNoSurface,
  kRange,
  kShadow,
  kGrazing,
  kDark,       ///< The dots do not stand out of the noise, of ambient light among others.
  kSaturated,  ///< Ambient light alone saturates the infra-red image.
  kNoMatch,    ///< Dots can be seen, but the block is not recognised: it straddles an edge.
  kBorder,     ///< The block leaves the infra-red image.
  /// In registered depth only: the depth camera sees something else there, or its pixels leave a
  /// gap.
  kNotRegistered,
};

/// A depth image with the reasons of its holes.
struct ExplainedDepth {
  DepthImage depth;
  cv::Mat1b no_return;  ///< NoReturn.
  /// The infra-red image in which MatchedDepth matched, 10 bits, of several images the last one;
  /// empty for ParametricDepth.
  cv::Mat1w infrared = {};
};

/// Determines why a block was not matched from the view of its central pixel.
class MissingReturn {
 public:
  /// Keeps references. `exposure`: of the image, as a share of the longest one.
  MissingReturn(const InfraredResponse& response, double exposure,
                const PatternMatchingOptions& matching, const DisparityRange& range)
      : response_(response), exposure_(exposure), matching_(matching), range_(range) {}

  /// The pixel's block must lie in the image.
  NoReturn Reason(const AovImages& aovs, cv::Point pixel) const;

 private:
  const InfraredResponse& response_;
  double exposure_;
  const PatternMatchingOptions& matching_;
  const DisparityRange& range_;
};

/// Registers depth images to the colour camera, as drivers do: every pixel is reprojected to where
/// the colour camera sees it. What only the colour camera sees becomes a hole at the foreground's
/// edge.
class DepthRegistrar {
 public:
  /// `depth`: the camera D of the depth images; `registered`: that of the result, at the colour
  /// camera K.
  DepthRegistrar(const CameraModel& depth, const Pose& X_KD, const CameraModel& registered);

  /// The reasons of holes are those of the depth pixels that should have been reprojected there.
  ExplainedDepth Register(const ExplainedDepth& depth, const RayCaster& caster,
                          const Lighting& lighting, const Pose& X_WK) const;

 private:
  NoReturn Reason(const ExplainedDepth& depth, cv::Point pixel, float z_m) const;

  CameraModel depth_;
  Pose X_DK_;
  RayGrid rays_;  ///< The rays of the registered camera.
  DepthReprojection reprojection_;
};

}  // namespace fenestra

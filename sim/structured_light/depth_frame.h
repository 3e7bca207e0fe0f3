#pragma once

#include <opencv2/core.hpp>

#include "core/detection/observation.h"

namespace fenestra {

/// Why a depth pixel has no return; for truth only, detectors never see it.
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
  /// Registered depth only: the depth camera sees something else there, or its pixels leave a gap.
  kNotRegistered,
};

/// A depth image with its reasons.
struct ExplainedDepth {
  DepthImage depth;
  cv::Mat1b no_return;  ///< NoReturn.
  /// What MatchedDepth matched: the infra-red image, 10 bits; empty for formulae. Of several images
  /// the last one.
  cv::Mat1w infrared = {};
};

}  // namespace fenestra

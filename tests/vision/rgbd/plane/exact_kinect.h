#pragma once

#include "core/detection/observation.h"
#include "core/geometry/calibration.h"
#include "core/random/random_stream.h"
#include "tests/vision/frame/exact_frame.h"

namespace fenestra::testing {

/// An exact frame before an RGB-D sensor. Its pose X_LO is that in D. Grey values are linear: 255
/// is full scale.
struct ExactKinectScene {
  ExactFrame frame{
      .X_LO = {}, .wall_dn = 60.0, .frame_dn = 4.0, .opening_dn = 60.0, .black_dn = 0.0};
  double setback_m = 0.0;      ///< Of the frame's front behind the wall.
  bool frame_returns = false;  ///< Depth on the frame.
  double opening_m = 0.0;  ///< Depth of what is seen in the opening behind the front; < 0: none.
};

struct ExactKinectNoise {
  double color_dn = 1.0;           ///< Of each linear channel.
  double inverse_depth = 1.15e-3;  ///< [1/m], before it is rounded; correlated by windows.
  double step = 2.9e-3;            ///< Quantum of the inverse depth [1/m].
  double window_px = 9.0;          ///< In pixels of a 640-wide image.
};

/// What does not change from one picture to the next.
struct ExactKinectPicture {
  cv::Mat1f linear_dn;
  cv::Mat1f inverse_depth;  ///< 0: no return.
};

ExactKinectPicture ExactPicture(const RgbdCalibration& calibration, const ExactKinectScene& scene);

/// That picture with noise, encoded as sRGB and rounded to 8 bits and to depth units.
RgbdObservation WithNoise(const ExactKinectPicture& picture, const RgbdCalibration& calibration,
                          const ExactKinectNoise& noise, const RandomStream& stream);

}  // namespace fenestra::testing

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/input_error.h"
#include "vision/detector_registry.h"

// A libFuzzer target: whatever the pixels, every detector gives a window, a Miss or an InputError.
// The bytes fill small images over and over, each row shifted by one more byte than the last.

namespace {

constexpr int kWidth_px = 96;
constexpr int kHeight_px = 72;

using namespace fenestra;

class Bytes {
 public:
  Bytes(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  cv::Mat Image(int type) {
    cv::Mat image(kHeight_px, kWidth_px, type);
    for (int v = 0; v < image.rows; ++v) {
      uint8_t* const row = image.ptr(v);
      const auto count = static_cast<size_t>(image.cols) * image.elemSize();
      for (size_t i = 0; i < count; ++i) row[i] = data_[(at_ + static_cast<size_t>(v) + i) % size_];
    }
    at_ = (at_ + size_ / 2) % size_;
    return image;
  }

 private:
  const uint8_t* data_;
  size_t size_;
  size_t at_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  cv::setNumThreads(1);
  const CameraModel camera({.width_px = kWidth_px,
                            .height_px = kHeight_px,
                            .fx_px = 80.0,
                            .fy_px = 80.0,
                            .cx_px = 47.5,
                            .cy_px = 35.5,
                            .distortion = {.k1 = -0.1}});
  for (const DetectorInfo& info : Detectors()) {
    Bytes bytes(data, size);
    StageLog log([] { return 0.0; }, true);
    try {
      if (info.sensor == SensorKind::kStereo) {
        const Pose X_RL(Eigen::Matrix3d::Identity(), {-0.1, 0.0, 0.0});
        MakeDetector(info.name, StereoCalibration{camera, camera, X_RL}, {})
            ->Detect(StereoObservation{bytes.Image(CV_8UC1), bytes.Image(CV_8UC1)}, log);
      } else {
        MakeDetector(info.name, RgbdCalibration{camera, camera, Pose()}, {})
            ->Detect(RgbdObservation{bytes.Image(CV_8UC3), {bytes.Image(CV_16UC1), 0.001}}, log);
      }
    } catch (const InputError&) {
    }
  }
  return 0;
}

#include <algorithm>
#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/io/input_error.h"
#include "vision/detector_registry.h"

// A libFuzzer target: whatever the pixels, every detector gives a window, a Miss or an InputError.
// Bytes say what is seen: a frame on a wall, nearly or not at all as one should be, so that the
// later stages are reached, too; the rest of them are single pixels that are changed. Where the
// first byte is odd they are the pixels, over and over.

namespace {

using namespace fenestra;

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;
constexpr double kFocal_px = 130.0;

class Bytes {
 public:
  Bytes(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  bool empty() const { return at_ >= size_; }
  int Next() { return empty() ? 0 : data_[at_++]; }
  double Between(double least, double most) { return least + (most - least) * Next() / 255.0; }

  // Each row begins one byte later than the last.
  void FillOver(cv::Mat image) {
    for (int v = 0; v < image.rows; ++v) {
      uint8_t* const row = image.ptr(v);
      const auto count = static_cast<size_t>(image.cols) * image.elemSize();
      for (size_t i = 0; i < count; ++i) row[i] = data_[(at_ + static_cast<size_t>(v) + i) % size_];
    }
    at_ = (at_ + size_ / 2) % size_;
  }

 private:
  const uint8_t* data_;
  size_t size_;
  size_t at_ = 0;
};

struct Images {
  cv::Mat1b left = cv::Mat1b::zeros(kHeight_px, kWidth_px);
  cv::Mat1b right = cv::Mat1b::zeros(kHeight_px, kWidth_px);
  cv::Mat3b color = cv::Mat3b::zeros(kHeight_px, kWidth_px);
  cv::Mat1w depth = cv::Mat1w::zeros(kHeight_px, kWidth_px);

  std::array<cv::Mat, 4> all() { return {left, right, color, depth}; }
};

using Corners = std::array<cv::Point2d, 4>;

void Fill(cv::Mat image, const Corners& corners, const cv::Scalar& value, double inwards) {
  constexpr int kFraction = 4;  // Bits.
  const cv::Point2d middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  std::vector<cv::Point> outline;
  for (const cv::Point2d& corner : corners) {
    outline.emplace_back((1 << kFraction) * (corner + inwards * (middle - corner)));
  }
  const int line = image.depth() == CV_8U ? cv::LINE_AA : cv::LINE_8;
  cv::fillConvexPoly(image, outline, value, line, kFraction);
}

void DrawFrame(Bytes& bytes, Images& images) {
  Corners left = {{{48.0, 28.0}, {112.0, 28.0}, {112.0, 92.0}, {48.0, 92.0}}};
  for (cv::Point2d& corner : left) {
    corner += cv::Point2d(bytes.Between(-16.0, 16.0), bytes.Between(-16.0, 16.0));
  }
  Corners right = left;
  const double disparity_px = bytes.Between(2.0, 20.0);
  for (cv::Point2d& corner : right) {
    corner -= cv::Point2d(disparity_px + bytes.Between(-1.0, 1.0), bytes.Between(-1.0, 1.0));
  }
  const double inwards = bytes.Between(0.05, 0.4);
  const cv::Scalar wall = cv::Scalar::all(bytes.Next());
  const cv::Scalar border = cv::Scalar::all(bytes.Next());
  const cv::Scalar opening = cv::Scalar::all(bytes.Next());
  for (const auto& [image, corners] : {std::pair<cv::Mat, Corners>{images.left, left},
                                       {images.right, right},
                                       {images.color, left}}) {
    cv::Mat(image).setTo(wall);
    Fill(image, corners, border, 0.0);
    Fill(image, corners, opening, inwards);
  }
  const double middle_mm = bytes.Between(500.0, 8000.0);
  const double by_u_mm = bytes.Between(-20.0, 20.0);
  const double by_v_mm = bytes.Between(-20.0, 20.0);
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const double z_mm = middle_mm + by_u_mm * (u - kWidth_px / 2) + by_v_mm * (v - 60);
      images.depth(v, u) = cv::saturate_cast<uint16_t>(z_mm);
    }
  }
  if (bytes.Next() % 2 == 0) Fill(images.depth, left, cv::Scalar::all(0), 0.0);
  if (bytes.Next() % 2 == 0) Fill(images.depth, left, cv::Scalar::all(256 * bytes.Next()), inwards);
  while (!bytes.empty()) {
    cv::Mat image = images.all()[static_cast<size_t>(bytes.Next() % 4)];
    uint8_t* const row = image.ptr(bytes.Next() % kHeight_px);
    const int bytes_of_row = kWidth_px * static_cast<int>(image.elemSize());
    const int place = (bytes.Next() * 256 + bytes.Next()) % bytes_of_row;
    row[place] = static_cast<uint8_t>(bytes.Next());
  }
}

Images Seen(const uint8_t* data, size_t size) {
  Bytes bytes(data, size);
  Images images;
  if (data[0] % 2 == 1) {
    for (cv::Mat& image : images.all()) bytes.FillOver(image);
  } else {
    bytes.Next();
    DrawFrame(bytes, images);
  }
  return images;
}

std::vector<std::unique_ptr<Detector>> MakeDetectors() {
  cv::setNumThreads(1);
  const CameraModel camera({.width_px = kWidth_px,
                            .height_px = kHeight_px,
                            .fx_px = kFocal_px,
                            .fy_px = kFocal_px,
                            .cx_px = 79.5,
                            .cy_px = 59.5,
                            .distortion = {.k1 = -0.1}});
  const StereoCalibration pair{camera, camera, Pose::Translation({-0.1, 0.0, 0.0})};
  const RgbdCalibration rgbd{camera, camera, Pose()};
  std::vector<std::unique_ptr<Detector>> detectors;
  for (const DetectorInfo& info : Detectors()) {
    detectors.push_back(info.sensor == SensorKind::kStereo ? MakeDetector(info.name, pair, {})
                                                           : MakeDetector(info.name, rgbd, {}));
  }
  return detectors;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::vector<std::unique_ptr<Detector>> detectors = MakeDetectors();
  if (size == 0) return 0;
  const Images images = Seen(data, size);
  for (const auto& detector : detectors) {
    StageLog log([] { return 0.0; }, true);
    try {
      if (detector->sensor() == SensorKind::kStereo) {
        detector->Detect(StereoObservation{images.left, images.right}, log);
      } else {
        detector->Detect(RgbdObservation{images.color, {images.depth, 0.001}}, log);
      }
    } catch (const InputError&) {
    }
  }
  return 0;
}

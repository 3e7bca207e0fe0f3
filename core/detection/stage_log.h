#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/geometry/camera_model.h"
#include "core/geometry/pose.h"

namespace fenestra {

/// Seconds since any fixed instant, never decreasing.
using Clock = std::function<double()>;

/// The monotonic clock of this machine.
Clock SteadyClock();

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// How points in front of camera C appear in a picture: p_PQ = X_PC p_CQ, then camera.Project.
struct PictureView {
  CameraModel camera;
  Pose X_PC;
};

/// An intermediate result that a person can look at.
struct StagePicture {
  std::string name;
  cv::Mat image;  ///< 8 bit, one or three channels (B, G, R).
  /// One for each camera image in the picture (two of them side by side: the second view's
  /// principal point is shifted by the first image's width). Estimates can be drawn over it.
  std::vector<PictureView> views;
};

struct StageCloud {
  std::string name;
  std::vector<Eigen::Vector3f> points_C;
};

/// Records a detector's way to an estimate: the time of each stage and, on request, its
/// intermediate pictures and clouds. Making a picture does not count as time of a stage.
///
///     log.Begin("rectify");  ...            // ends with the next Begin or with End
///     log.Picture("rectified", [&] { return Draw(...); });
class StageLog {
 public:
  /// With keep_artifacts false, Picture and Cloud do not even call their makers.
  explicit StageLog(Clock clock, bool keep_artifacts = false);

  /// Ends the running stage, if any, and starts the next one. A stage that is begun twice adds up.
  void Begin(const std::string& stage);
  void End();
  /// Adds a stage that was timed elsewhere, finite and not negative.
  void Add(const StageTime& time);

  void Picture(const std::string& name, const std::function<cv::Mat()>& make,
               const std::vector<PictureView>& views = {});
  void Cloud(const std::string& name, const std::function<std::vector<Eigen::Vector3f>()>& make);

  bool keeps_artifacts() const { return keep_artifacts_; }
  /// Stages in the order in which they were first begun.
  const std::vector<StageTime>& times() const { return times_; }
  const std::vector<StagePicture>& pictures() const { return pictures_; }
  const std::vector<StageCloud>& clouds() const { return clouds_; }
  double TotalSeconds() const;

 private:
  /// Index of the stage in times_, to which a new stage is added.
  size_t IndexOf(const std::string& stage);
  /// Runs `make` with the clock of the running stage stopped.
  void OffTheClock(const std::function<void()>& make);

  Clock clock_;
  bool keep_artifacts_;
  int running_ = -1;  ///< Index into times_, or -1.
  double resumed_at_ = 0.0;
  std::vector<StageTime> times_;
  std::vector<StagePicture> pictures_;
  std::vector<StageCloud> clouds_;
};

}  // namespace fenestra

#include "core/detection/stage_log.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/system/check.h"

namespace fenestra {

Clock SteadyClock() {
  return [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
  };
}

StageLog::StageLog(Clock clock, bool keep_artifacts)
    : clock_(std::move(clock)), keep_artifacts_(keep_artifacts) {}

size_t StageLog::IndexOf(const std::string& stage) {
  const auto found = std::find_if(times_.begin(), times_.end(),
                                  [&stage](const StageTime& time) { return time.stage == stage; });
  const auto index = static_cast<size_t>(found - times_.begin());
  if (found == times_.end()) times_.push_back({stage, 0.0});
  return index;
}

void StageLog::Begin(const std::string& stage) {
  End();
  running_ = static_cast<int>(IndexOf(stage));
  resumed_at_ = clock_();
}

void StageLog::Add(const StageTime& time) {
  FENESTRA_CHECK(std::isfinite(time.seconds) && time.seconds >= 0.0, "time of " + time.stage);
  times_[IndexOf(time.stage)].seconds += time.seconds;
}

void StageLog::End() {
  if (running_ >= 0) times_[static_cast<size_t>(running_)].seconds += clock_() - resumed_at_;
  running_ = -1;
}

void StageLog::Picture(const std::string& name, const std::function<cv::Mat()>& make,
                       const std::vector<PictureView>& views) {
  if (keep_artifacts_) OffTheClock([&] { pictures_.push_back({name, make(), views}); });
}

void StageLog::Cloud(const std::string& name,
                     const std::function<std::vector<Eigen::Vector3f>()>& make) {
  if (keep_artifacts_) OffTheClock([&] { clouds_.push_back({name, make()}); });
}

void StageLog::OffTheClock(const std::function<void()>& make) {
  const int paused = running_;
  End();
  make();
  running_ = paused;
  if (running_ >= 0) resumed_at_ = clock_();
}

double StageLog::TotalSeconds() const {
  double total = 0.0;
  for (const StageTime& time : times_) total += time.seconds;
  return total;
}

}  // namespace fenestra

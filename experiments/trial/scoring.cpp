#include "experiments/trial/scoring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "core/detection/detector.h"
#include "core/io/input_error.h"
#include "core/io/system_error.h"

namespace fenestra {
namespace {

using Answer = std::variant<WindowEstimate, Miss, Crash>;

std::string ToText(const Eigen::Vector3d& p_C) {
  return fmt::format("({}, {}, {}) m", p_C.x(), p_C.y(), p_C.z());
}

/// Why an estimate is nonsense regardless of the truth; empty if it is not.
std::string Nonsense(const WindowEstimate& estimate) {
  const auto check = [](const char* what, const Eigen::Vector3d& p_C) -> std::string {
    if (!p_C.allFinite()) return fmt::format("{} is not finite: {}", what, ToText(p_C));
    if (p_C.z() <= 0.0) return fmt::format("{} is behind the camera: {}", what, ToText(p_C));
    return "";
  };
  std::string fault = check("the centroid", estimate.p_CO);
  for (const Eigen::Vector3d& p_CV : estimate.p_CV) {
    if (fault.empty()) fault = check("a corner", p_CV);
  }
  if (!fault.empty()) return fault;
  if (!estimate.normal_C.allFinite()) return "the normal is not finite";
  if (estimate.covariance_C && !estimate.covariance_C->allFinite()) {
    return "the covariance is not finite";
  }
  return "";
}

Answer Judge(const std::variant<Detection, Crash>& detection) {
  if (const Crash* crash = std::get_if<Crash>(&detection)) return *crash;
  const Detection& answer = std::get<Detection>(detection);
  if (const Miss* miss = std::get_if<Miss>(&answer)) return *miss;
  const WindowEstimate& estimate = std::get<WindowEstimate>(answer);
  if (std::string fault = Nonsense(estimate); !fault.empty()) return Crash{"nonsense", fault};
  return estimate;
}

double Tolerance(const WindowTruth& window) {
  return kHitFraction * std::min(window.width_m, window.height_m);
}

Outcome OutcomeOf(const WindowEstimate& estimate, const GroundTruth& truth) {
  const double error = (estimate.p_CO - truth.target->p_CO).norm();
  double nearest = std::numeric_limits<double>::infinity();
  bool recognised = false;  // The nearest other window lies within its own tolerance.
  for (const WindowTruth& window : truth.other_windows) {
    const double distance = (estimate.p_CO - window.p_CO).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    recognised = distance <= Tolerance(window);
  }
  if (nearest < error && recognised) return Outcome::kWrongWindow;
  return error <= Tolerance(*truth.target) ? Outcome::kHit : Outcome::kGross;
}

Outcome OutcomeOf(const Answer& answer, const GroundTruth& truth) {
  if (truth.target && !truth.in_view) return Outcome::kOutOfView;
  if (std::holds_alternative<Crash>(answer)) return Outcome::kCrashed;
  const WindowEstimate* estimate = std::get_if<WindowEstimate>(&answer);
  if (!truth.target) return estimate ? Outcome::kFalseAlarm : Outcome::kClear;
  return estimate ? OutcomeOf(*estimate, truth) : Outcome::kMissed;
}

}  // namespace

std::variant<Detection, Crash> DetectionOrCrash(const std::function<Detection()>& detect,
                                                bool own) {
  try {
    return detect();
  } catch (const InputError& error) {
    if (own) throw;
    return Crash{"exception", error.what()};
  } catch (const DetectorFailure& failure) {
    return Crash{failure.kind(), failure.what()};
  } catch (const SystemError&) {
    throw;  // No detector is to blame.
  } catch (const std::exception& error) {
    return Crash{"exception", error.what()};
  } catch (...) {
    return Crash{"exception", "of a type that is not std::exception"};
  }
}

Score ScoreDetection(const std::variant<Detection, Crash>& detection, const GroundTruth& truth) {
  const Answer answer = Judge(detection);
  Score score;
  score.outcome = OutcomeOf(answer, truth);
  if (const WindowEstimate* estimate = std::get_if<WindowEstimate>(&answer)) {
    score.estimate = *estimate;
  } else if (const Miss* miss = std::get_if<Miss>(&answer)) {
    score.reason = miss->reason;
    score.detail = miss->detail;
  } else {
    const Crash& crash = std::get<Crash>(answer);
    score.reason = crash.kind;
    score.detail = crash.detail;
  }
  if (truth.target) score.truth_p_CO = truth.target->p_CO;
  return score;
}

}  // namespace fenestra

#pragma once

#include <functional>
#include <string>
#include <variant>

#include "core/detection/detection.h"
#include "experiments/trial/trial_record.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// A detector that gave neither an estimate nor a Miss.
struct Crash {
  std::string kind;    ///< A stable identifier in snake_case: "exception", "timeout", "nonsense".
  std::string detail;  ///< The exception's text or the offending numbers, for people.
};

/// The detection that `detect` returns, or a Crash: of the kind that a DetectorFailure names, or of
/// kind "exception" for anything else that it throws. Two kinds pass: a SystemError, since what the
/// machine could not do is no fault of the detector, and an InputError of a detector that is `own`,
/// one of Fenestra's: the calibration or the images are at fault then, and no figure of the detector
/// would say so.
std::variant<Detection, Crash> DetectionOrCrash(const std::function<Detection()>& detect,
                                                bool own = false);

/// A hit is at most this fraction of the window's side away from the truth. The side is the smaller
/// of width and height: a drone that aims so far off centre keeps a quarter of the side to the
/// edge.
inline constexpr double kHitFraction = 0.25;

/// Holds a detection against the truth: the only place where the two meet. With e the distance of
/// the estimated centroid from the target's and e_i from that of other window i:
///
///     no target in the scene      crashed | false_alarm (any estimate) | clear (Miss)
///     target not wholly in view   out_of_view, whatever the detector said; estimate and reason
///                                 are kept
///     otherwise                   crashed | missed |
///                                 wrong_window   if e_i < e and e_i ≤ kHitFraction side_i
///                                                for the nearest other window i
///                                 hit            else if e ≤ kHitFraction side
///                                 gross          else
///
/// An estimate with a number that is not finite, or with its centroid or a corner behind the camera
/// (z ≤ 0), counts as a Crash of kind "nonsense" and is not kept.
Score ScoreDetection(const std::variant<Detection, Crash>& detection, const GroundTruth& truth);

}  // namespace fenestra

#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/detection/detection.h"
#include "vision/frame/adjustment/frame_fit.h"
#include "vision/frame/detection/darkness.h"

namespace fenestra {

/// Mean over the views of DarkInside for the frame's outer sides, evaluated piecewise because the
/// lens bends them.
double FrameClarity(std::span<const CameraView> views, const FrameRectangle& frame,
                    const DarknessSettings& settings);

/// Mean over the views of the ratio of the frame's grey value to the wall's: DarkOverBright along
/// the outer sides.
double FrameGreyRatio(std::span<const CameraView> views, const FrameRectangle& frame,
                      const DarknessSettings& settings);

/// Score of a fitted frame, 0 to 1: combines its clarity and the share of its sides that was found,
/// and is lowered if the sides do not lie in one plane or if a bright band surrounds the frame
/// (BrightBand).
double FrameScore(std::span<const CameraView> views, const FrameFit& fit,
                  const DarknessSettings& settings);

/// Returns "not_dark" for a frame whose clarity is below `min_clarity`.
std::optional<Miss> ObjectionToClarity(std::span<const CameraView> views,
                                       const FrameRectangle& frame,
                                       const DarknessSettings& settings, double min_clarity);

/// The estimate that a finished fit stands for, with its covariance. Its score is the mean of the
/// finished fit's and the rough fit's, so that a rough fit cannot hide behind freedoms that it did
/// not have.
WindowEstimate EstimateOf(std::span<const CameraView> views, const FrameFit& fit,
                          double rough_score, const DarknessSettings& settings);

/// Finished fits, the highest score first, and why the first of the failed ones failed.
template <typename Finished>
struct BestFits {
  std::vector<Finished> found;
  std::optional<Miss> objection;

  /// The best estimate, which names the others. Domain: `found` is not empty.
  WindowEstimate Chosen() const {
    WindowEstimate chosen = found.front().estimate;
    for (size_t i = 1; i < found.size(); ++i) chosen.others.push_back(found[i].estimate);
    return chosen;
  }
};

/// Finishes rough fits in the order of their scores until `most_windows` have succeeded.
/// `finish(candidate)` returns a variant of a fit with an `estimate` and a Miss. Gives up after
/// four attempts, since each takes some milliseconds, and leaves out candidates whose rough score
/// is less than 0.7 of the first success.
template <typename Candidate, typename Finish>
auto FinishBest(std::vector<Candidate> candidates, int most_windows, Finish finish) {
  constexpr size_t kMostFinished = 4;
  constexpr double kHopeless = 0.7;
  using Result = std::invoke_result_t<Finish, Candidate&>;
  using Finished = std::variant_alternative_t<0, Result>;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  if (candidates.size() > kMostFinished)
    candidates.erase(candidates.begin() + kMostFinished, candidates.end());
  BestFits<Finished> best;
  for (Candidate& candidate : candidates) {
    if (best.found.size() == static_cast<size_t>(most_windows)) break;
    if (!best.found.empty() &&
        candidate.score < kHopeless * best.found.front().estimate.score.value()) {
      break;
    }
    Result result = finish(candidate);
    if (const Miss* miss = std::get_if<Miss>(&result)) {
      if (!best.objection) best.objection = *miss;
    } else {
      best.found.push_back(std::move(std::get<Finished>(result)));
    }
  }
  std::stable_sort(best.found.begin(), best.found.end(), [](const Finished& a, const Finished& b) {
    return a.estimate.score.value() > b.estimate.score.value();
  });
  return best;
}

}  // namespace fenestra

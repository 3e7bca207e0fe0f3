#include "sim/window_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/wide.h"

namespace fenestra {
namespace {

enum Field {
  kDots,
  kDots2,
  kAmbient,
  kSmooth2,
  kEvidence,
  kMoment,
  kDisparity,
  kStrongest,
  kStrongestDisparity,
  kFields
};

// How much of each pixel a side of this length covers, of all of it.
std::vector<float> Weights(double side_px) {
  const int reach = static_cast<int>(std::ceil(0.5 * side_px - 0.5));
  std::vector<float> weights;
  for (int i = -reach; i <= reach; ++i) {
    const double covered = std::min(i + 0.5, 0.5 * side_px) - std::max(i - 0.5, -0.5 * side_px);
    weights.push_back(static_cast<float>(covered / side_px));
  }
  return weights;
}

struct Pixel {
  float weight;
  float x;
  float pattern_mean;
  float narrowness;
};

// Adds one pixel of each window: that at the same place of all of them.
FENESTRA_WIDE void AddPixel(const float* __restrict dots, const float* __restrict ambient,
                            const float* __restrict places, const float* __restrict disparity,
                            Pixel p, float* __restrict sums, int count) {
  float* const sum_dots = sums + kDots * count;
  float* const sum_dots2 = sums + kDots2 * count;
  float* const sum_ambient = sums + kAmbient * count;
  float* const sum_smooth2 = sums + kSmooth2 * count;
  float* const sum_evidence = sums + kEvidence * count;
  float* const sum_moment = sums + kMoment * count;
  float* const sum_disparity = sums + kDisparity * count;
  float* const strongest = sums + kStrongest * count;
  float* const strongest_disparity = sums + kStrongestDisparity * count;
  for (int i = 0; i < count; ++i) {
    const float s = dots[i];
    const float weighted = p.weight * s;
    const float smooth = p.pattern_mean * s + ambient[i];
    // exp(-q) = (exp(-q/32))³².
    const float apart = places[i] - disparity[i];
    float fit = std::max(0.0f, 1.0f - apart * apart * (p.narrowness / 32.0f));
    fit *= fit;
    fit *= fit;
    fit *= fit;
    fit *= fit;
    fit *= fit;
    const float evidence = weighted * fit;
    sum_dots[i] += weighted;
    sum_dots2[i] += weighted * s;
    sum_ambient[i] += p.weight * ambient[i];
    sum_smooth2[i] += p.weight * smooth * smooth;
    sum_evidence[i] += evidence;
    sum_moment[i] += evidence * p.x;
    sum_disparity[i] += evidence * places[i];
    const bool is_stronger = s > strongest[i];
    strongest[i] = is_stronger ? s : strongest[i];
    strongest_disparity[i] = is_stronger ? places[i] : strongest_disparity[i];
  }
}

WindowEvidence EvidenceIn(const cv::Mat1f& sums, int i) {
  return {.dots = sums(kDots, i),
          .dots2 = sums(kDots2, i),
          .ambient = sums(kAmbient, i),
          .smooth2 = sums(kSmooth2, i),
          .evidence = sums(kEvidence, i),
          .moment = sums(kMoment, i),
          .disparity = sums(kDisparity, i),
          .strongest = sums(kStrongest, i),
          .strongest_disparity = sums(kStrongestDisparity, i)};
}

}  // namespace

WindowGatherer::WindowGatherer(double width_px, double height_px, double pattern_mean,
                               double spread_px)
    : weights_u_(Weights(width_px)),
      weights_v_(Weights(height_px)),
      pattern_mean_(static_cast<float>(pattern_mean)),
      narrowness_(static_cast<float>(1.0 / (4.0 * spread_px * spread_px))) {}

cv::Mat1f WindowGatherer::Gather(const WindowLight& light, cv::Point first,
                                 const float* disparity_px, int count) const {
  cv::Mat1f sums = cv::Mat1f::zeros(kFields, count);
  for (int y = -reach_v(); y <= reach_v(); ++y) {
    for (int x = -reach_u(); x <= reach_u(); ++x) {
      const Pixel pixel{.weight = weights_u_[static_cast<size_t>(x + reach_u())] *
                                  weights_v_[static_cast<size_t>(y + reach_v())],
                        .x = static_cast<float>(x),
                        .pattern_mean = pattern_mean_,
                        .narrowness = narrowness_};
      const int column = first.x + x;
      AddPixel(light.dots_dn[first.y + y] + column, light.ambient_dn[first.y + y] + column,
               light.disparity_px[first.y + y] + column, disparity_px, pixel, sums[0], count);
    }
  }
  return sums;
}

std::vector<WindowEvidence> WindowGatherer::Row(const WindowLight& light, int v) const {
  const int count = light.dots_dn.cols - 2 * reach_u();
  std::vector<WindowEvidence> windows;
  if (count <= 0 || v < reach_v() || v + reach_v() >= light.dots_dn.rows) return windows;
  const cv::Mat1f sums = Gather(light, {reach_u(), v}, light.disparity_px[v] + reach_u(), count);
  windows.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) windows.push_back(EvidenceIn(sums, i));
  return windows;
}

WindowEvidence WindowGatherer::At(const WindowLight& light, cv::Point pixel,
                                  float disparity_px) const {
  return EvidenceIn(Gather(light, pixel, &disparity_px, 1), 0);
}

}  // namespace fenestra

#include "sim/structured_light/block_evidence.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "core/system/wide.h"

namespace fenestra {
namespace {

// Fields of BlockEvidence: those that depend on a block's own disparity, and those that do
// not, which are gathered column by column and then row by row.
enum OwnField { kEvidence, kDisparity, kOwnFields };
enum BoxField { kDots, kDots2, kAmbient, kSmooth2, kStrongest, kStrongestDisparity, kBoxFields };

// Share of each pixel in a side of this length.
std::vector<float> Weights(double side_px) {
  const int reach = BlockReach(side_px);
  std::vector<float> weights;
  for (int i = -reach; i <= reach; ++i) {
    const double covered = std::min(i + 0.5, 0.5 * side_px) - std::max(i - 0.5, -0.5 * side_px);
    weights.push_back(static_cast<float>(covered / side_px));
  }
  return weights;
}

struct Pixel {
  float weight;
  float narrowness;
};

// Adds one pixel of each block: that at the same place of all of them.
FENESTRA_WIDE void AddEvidence(const float* __restrict dots, const float* __restrict places,
                               const float* __restrict disparity, Pixel p, float* __restrict sums,
                               int count) {
  float* const sum_evidence = sums + kEvidence * count;
  float* const sum_disparity = sums + kDisparity * count;
  for (int i = 0; i < count; ++i) {
    // exp(-q) = (exp(-q/32))³².
    const float apart = places[i] - disparity[i];
    float fit = std::max(0.0f, 1.0f - apart * apart * (p.narrowness / 32.0f));
    fit *= fit;
    fit *= fit;
    fit *= fit;
    fit *= fit;
    fit *= fit;
    const float evidence = p.weight * dots[i] * fit;
    sum_evidence[i] += evidence;
    sum_disparity[i] += evidence * places[i];
  }
}

// Adds one row of the blocks to the sums over their columns.
FENESTRA_WIDE void AddRow(const float* __restrict dots, const float* __restrict ambient,
                          const float* __restrict places, float weight, float pattern_mean,
                          float* __restrict columns, int count) {
  float* const strongest = columns + kStrongest * count;
  float* const strongest_disparity = columns + kStrongestDisparity * count;
  for (int i = 0; i < count; ++i) {
    const float s = dots[i];
    const float smooth = pattern_mean * s + ambient[i];
    columns[kDots * count + i] += weight * s;
    columns[kDots2 * count + i] += weight * s * s;
    columns[kAmbient * count + i] += weight * ambient[i];
    columns[kSmooth2 * count + i] += weight * smooth * smooth;
    const bool is_stronger = s > strongest[i];
    strongest[i] = is_stronger ? s : strongest[i];
    strongest_disparity[i] = is_stronger ? places[i] : strongest_disparity[i];
  }
}

// Adds the columns that are at the same place of all blocks; `stride`: from one field of the
// columns to the next.
FENESTRA_WIDE void AddColumn(const float* __restrict columns, int stride, float weight,
                             float* __restrict sums, int count) {
  for (int field = kDots; field <= kSmooth2; ++field) {
    const float* const in = columns + field * stride;
    float* const out = sums + field * count;
    for (int i = 0; i < count; ++i) out[i] += weight * in[i];
  }
  const float* const strong = columns + kStrongest * stride;
  const float* const strong_disparity = columns + kStrongestDisparity * stride;
  float* const strongest = sums + kStrongest * count;
  float* const strongest_disparity = sums + kStrongestDisparity * count;
  for (int i = 0; i < count; ++i) {
    const bool is_stronger = strong[i] > strongest[i];
    strongest[i] = is_stronger ? strong[i] : strongest[i];
    strongest_disparity[i] = is_stronger ? strong_disparity[i] : strongest_disparity[i];
  }
}

// The x that a standard normal number exceeds with this probability.
double NormalWithTail(double probability) {
  using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  return std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability, InDouble());
}

}  // namespace

int BlockReach(double side_px) {
  return static_cast<int>(std::ceil(0.5 * side_px - 0.5));
}

BlockGatherer::BlockGatherer(double width_px, double height_px, double pattern_mean,
                             double spread_px)
    : weights_u_(Weights(width_px)),
      weights_v_(Weights(height_px)),
      pattern_mean_(static_cast<float>(pattern_mean)),
      narrowness_(static_cast<float>(1.0 / (4.0 * spread_px * spread_px))) {}

std::vector<BlockEvidence> BlockGatherer::Gather(const BlockLight& light, cv::Point first,
                                                 const float* disparity_px, int count) const {
  cv::Mat1f own = cv::Mat1f::zeros(kOwnFields, count);
  cv::Mat1f columns = cv::Mat1f::zeros(kBoxFields, count + 2 * reach_u());
  cv::Mat1f box = cv::Mat1f::zeros(kBoxFields, count);
  for (int y = -reach_v(); y <= reach_v(); ++y) {
    const float weight_v = weights_v_[static_cast<size_t>(y + reach_v())];
    const float* const dots = light.dots_dn[first.y + y] + first.x;
    const float* const places = light.disparity_px[first.y + y] + first.x;
    AddRow(dots - reach_u(), light.ambient_dn[first.y + y] + first.x - reach_u(),
           places - reach_u(), weight_v, pattern_mean_, columns[0], columns.cols);
    for (int x = -reach_u(); x <= reach_u(); ++x) {
      AddEvidence(dots + x, places + x, disparity_px,
                  {.weight = weights_u_[static_cast<size_t>(x + reach_u())] * weight_v,
                   .narrowness = narrowness_},
                  own[0], count);
    }
  }
  for (int x = 0; x <= 2 * reach_u(); ++x) {
    AddColumn(columns[0] + x, columns.cols, weights_u_[static_cast<size_t>(x)], box[0], count);
  }
  std::vector<BlockEvidence> blocks;
  blocks.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    blocks.push_back({.dots = box(kDots, i),
                      .dots2 = box(kDots2, i),
                      .ambient = box(kAmbient, i),
                      .smooth2 = box(kSmooth2, i),
                      .evidence = own(kEvidence, i),
                      .disparity = own(kDisparity, i),
                      .strongest = box(kStrongest, i),
                      .strongest_disparity = box(kStrongestDisparity, i)});
  }
  return blocks;
}

std::vector<BlockEvidence> BlockGatherer::Row(const BlockLight& light, int v) const {
  const int count = light.dots_dn.cols - 2 * reach_u();
  if (count <= 0 || v < reach_v() || v + reach_v() >= light.dots_dn.rows) return {};
  return Gather(light, {reach_u(), v}, light.disparity_px[v] + reach_u(), count);
}

BlockEvidence BlockGatherer::At(const BlockLight& light, cv::Point pixel,
                                float disparity_px) const {
  return Gather(light, pixel, &disparity_px, 1).front();
}

double NormalShare(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

double SumOfGaussian(double w) {
  double along = 1.0;
  for (int k = 1; k < 8; ++k) along += 2.0 * std::exp(-k * k / w);
  return along * along;
}

float ChanceMatch::Best(float enough, float nu) const {
  const double least = static_cast<double>(enough) / deviation;
  // Most blocks need not evaluate the functions below: 1000 Φ(-5) = Φ(-3.4).
  if (least > 5.0 && nu < 3.4f && places < 1000.0) return -1.0f;
  const double share = NormalShare(static_cast<double>(nu));
  if (share <= std::pow(NormalShare(least), places)) return -1.0f;
  // The upper tail: 1 - Φ(x/σ) = 1 - Φ(ν)^(1/N).
  const double tail = -std::expm1(std::log(share) / places);
  return static_cast<float>(deviation * NormalWithTail(tail));
}

}  // namespace fenestra

#include "renderers/light/light_elements.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fenestra {
namespace {

constexpr float kOfDistance = 1.0f;
constexpr float kShortestElement_m = 0.05f;
constexpr float kLongestElement_m = 0.64f;
constexpr uint32_t kMostHalvings = 12;
constexpr uint32_t kMostSamples = 8;

// The least number of halvings that makes a side this short.
uint32_t HalvingsOf(float side_m, float longest_m) {
  uint32_t halvings = 0;
  while (side_m > longest_m && halvings < kMostHalvings) {
    side_m *= 0.5f;
    ++halvings;
  }
  return halvings;
}

uint32_t CellOf(float at, uint32_t halvings) {
  const auto count = static_cast<int>(1u << halvings);
  return static_cast<uint32_t>(
      std::clamp(static_cast<int>(at * static_cast<float>(count)), 0, count - 1));
}

// A number that is spread evenly over all of its range.
uint32_t Scrambled(uint32_t i) {
  i = (i ^ (i >> 16)) * 0x7feb352du;
  i = (i ^ (i >> 15)) * 0x846ca68bu;
  return i ^ (i >> 16);
}

}  // namespace

uint32_t LightElements::See(const LightPatches& patches, uint32_t face, const Sample& at,
                            float distance_m) {
  const LightPatch& patch = patches.PatchOfFace(face);
  if (!LightPatches::IsFront(face) && !patch.has_back) return kNone;
  uint64_t key = static_cast<uint64_t>(face) << 32;
  if (!patch.is_smooth) {
    // Powers of two, so that elements that are seen from about the same distance are the same.
    const float longest_m =
        std::exp2(std::floor(std::log2(std::max(kOfDistance * distance_m, kShortestElement_m))));
    const float limited_m = std::min(longest_m, kLongestElement_m);
    const uint32_t s_halvings = HalvingsOf(patch.width_m, limited_m);
    const uint32_t t_halvings = HalvingsOf(patch.height_m, limited_m);
    key |= (s_halvings << 28) | (t_halvings << 24) | (CellOf(at.st.x, s_halvings) << 12) |
           CellOf(at.st.y, t_halvings);
  }
  const auto [entry, is_new] = index_.try_emplace(key, static_cast<uint32_t>(elements_.size()));
  if (is_new) elements_.push_back({.face = face, .times_seen = 0, .samples = {}});
  Element& element = elements_[entry->second];
  if (element.samples.size() < kMostSamples) {
    element.samples.push_back(at);
  } else {
    // All that are seen have the same chance to be among the samples.
    const uint32_t slot = Scrambled(element.times_seen) % (element.times_seen + 1);
    if (slot < kMostSamples) element.samples[slot] = at;
  }
  ++element.times_seen;
  return entry->second;
}

}  // namespace fenestra

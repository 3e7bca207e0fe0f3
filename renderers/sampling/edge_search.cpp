#include "renderers/sampling/edge_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fenestra {
namespace {

using Arriving = LightTransport::Arriving;

constexpr int kBorders = 4;
// A probe nearer than this to the edge that the lines have found may be on either side of it.
constexpr float kNear = 1.0f / 64.0f;

// Lines, which share the lanes of a packet. A third thing that turns up when the edge is known to
// within kSliverIn is a sliver along it, as a frame's rim; it is counted with what is behind it.
template <int lines>
struct Search {
  static constexpr int kLines = lines;
  static constexpr int kPointsPerLine = kLanes / lines;  // Of one packet.
};
struct Fine : Search<16> {
  static constexpr int kProbes = 32;  // Samples all over the pixel.
  static constexpr bool kAlwaysProbes = true;
  static constexpr int kSteps = 8;  // Halving a line each time: to 1/256.
  static constexpr int kGrid = 256;
  static constexpr float kSliverIn = 1.0f / 60.0f;
};
struct Quick : Search<4> {
  static constexpr int kProbes = 16;
  static constexpr bool kAlwaysProbes = false;  // The first points on the lines are all over it.
  static constexpr int kSteps = 3;              // To a fifth each time.
  static constexpr int kGrid = 125;
  static constexpr float kSliverIn = 1.0f / 24.0f;
};

template <typename How>
float LineAt(int line) {
  return (static_cast<float>(line) + 0.5f) / static_cast<float>(How::kLines);
}

// All samples of a pixel with their places.
struct Sighting {
  float s;
  float t;
  uint32_t key;
};

// One of the two things that are visible.
struct Thing {
  uint32_t key = 0;
  int count = 0;
  float s_sum = 0.0f;
  float t_sum = 0.0f;
  std::array<float, LightTransport::kMostChannels> radiance_sum{};
};

template <typename How>
class EdgeSearch {
 public:
  static constexpr int kLines = How::kLines;

  EdgeSearch(const PixelSampler& sampler, Film::Pixel pixel)
      : sampler_(sampler), pixel_(pixel), patch_(sampler.PatchOf(pixel)) {}

  std::optional<Film::QuarteredResult> Run(const Film::PixelResult& known) {
    if (!LookAtBorders()) return std::nullopt;
    if (thing_count_ == 1 && things_[0].key == known.key) {
      const std::array<Film::Radiance, 4> alike = {known.radiance, known.radiance, known.radiance,
                                                   known.radiance};
      return Film::QuarteredResult{.quarters = alike, .key = known.key};
    }
    if ((How::kAlwaysProbes || thing_count_ == 1) && !LookInside()) return std::nullopt;
    if (thing_count_ == 1) return Result({1.0f, 1.0f, 1.0f, 1.0f}, things_[0].key);
    const float ds = things_[0].s_sum / static_cast<float>(things_[0].count) -
                     things_[1].s_sum / static_cast<float>(things_[1].count);
    const float dt = things_[0].t_sum / static_cast<float>(things_[0].count) -
                     things_[1].t_sum / static_cast<float>(things_[1].count);
    along_s_ = std::abs(ds) >= std::abs(dt);
    if (!Bisect() || !Agrees()) return std::nullopt;
    return Result(AreasOfThing0(), Film::kMixed);
  }

 private:
  using Keys = std::array<uint32_t, kLines>;  // Of each line's beginning or end.
  using Places = std::array<float, kLines>;   // On each line.

  // Adds the samples of a packet; returns false if one of them saw a third thing, or a penumbra,
  // which has no edge.
  bool Note(const PixelPoints& points, const Arriving& arriving) {
    for (int i = 0; i < kLanes; ++i) {
      if (arriving.penumbra[i] != 0) return false;
      const uint32_t key = arriving.key[i];
      size_t k = 0;
      while (k < thing_count_ && things_[k].key != key) ++k;
      if (k == thing_count_) {
        if (thing_count_ == things_.size()) return false;
        things_[thing_count_++].key = key;
      }
      Thing& thing = things_[k];
      ++thing.count;
      thing.s_sum += points.s[i];
      thing.t_sum += points.t[i];
      for (size_t c = 0; c < sampler_.channel_count(); ++c) {
        thing.radiance_sum[c] += arriving.radiance[c][i];
      }
      sightings_[sighting_count_++] = {points.s[i], points.t[i], key};
    }
    return true;
  }

  bool LookInside() {
    for (int first = 0; first < How::kProbes; first += kLanes) {
      const PixelPoints points = sampler_.SamplePoints(pixel_, first);
      if (!Note(points, sampler_.Trace(patch_, points))) return false;
    }
    return true;
  }

  // Samples the ends of all lines, of those along s and of those along t.
  bool LookAtBorders() {
    for (int first = 0; first < kBorders * kLines; first += kLanes) {
      PixelPoints points;
      for (int i = 0; i < kLanes; ++i) {
        const int border = (first + i) / kLines;
        const float line = LineAt<How>((first + i) % kLines);
        const float end = border % 2 == 0 ? 0.0f : 1.0f;
        points.s[i] = border < 2 ? end : line;
        points.t[i] = border < 2 ? line : end;
      }
      const Arriving arriving = sampler_.Trace(patch_, points);
      for (int i = 0; i < kLanes; ++i) {
        border_keys_[static_cast<size_t>((first + i) / kLines)]
                    [static_cast<size_t>((first + i) % kLines)] = arriving.key[i];
      }
      if (!Note(points, arriving)) return false;
    }
    return true;
  }

  // Finds the thing that comes first along the lines; returns false if lines differ in that.
  bool Orient(const Keys& begins, const Keys& ends) {
    bool crossed = false;
    for (size_t i = 0; i < kLines; ++i) {
      if (begins[i] == ends[i]) continue;
      if (crossed && begins[i] != first_) return false;
      first_ = begins[i];
      crossed = true;
    }
    return crossed;
  }

  // Finds the interval of each line in which the edge cuts it.
  struct Cuts {
    Places low;
    Places high;
  };

  bool Bisect() {
    const Keys& begins = border_keys_[along_s_ ? 0 : 2];
    const Keys& ends = border_keys_[along_s_ ? 1 : 3];
    if (!Orient(begins, ends)) return false;
    // The points that the search tries lie on a grid; shifted at random on each line, it leaves
    // errors that are independent and without bias.
    constexpr float kStep = 1.0f / (How::kGrid - 1);
    const uint32_t seed = sampler_.SeedsOf(pixel_).x;
    Cuts cuts;
    for (size_t i = 0; i < kLines; ++i) {
      cuts.low[i] = -kStep * ToUnit(Hashed(seed + static_cast<uint32_t>(i)));
      cuts.high[i] = cuts.low[i] + 1.0f + kStep;
    }
    for (int step = 0; step < How::kSteps; ++step) {
      if (!Narrow(step, begins, ends, cuts)) return false;
    }
    for (size_t i = 0; i < kLines; ++i) {
      edge_[i] = begins[i] != ends[i] ? std::clamp(0.5f * (cuts.low[i] + cuts.high[i]), 0.0f, 1.0f)
                                      : (begins[i] == first_ ? 1.0f : 0.0f);
    }
    return true;
  }

  // Samples all points of a packet at even intervals of each line; returns false if a third thing
  // turns up or a line is crossed more than once.
  bool Narrow(int step, const Keys& begins, const Keys& ends, Cuts& cuts) {
    constexpr int kPoints = How::kPointsPerLine;
    Lanes<float> places;
    PixelPoints points;
    for (int i = 0; i < kLanes; ++i) {
      const auto line = static_cast<size_t>(i / kPoints);
      const float share = static_cast<float>(i % kPoints + 1) / static_cast<float>(kPoints + 1);
      const float low = cuts.low[line];
      // Halves are formed as a mean, which rounds alike on all lines.
      places[i] =
          kPoints == 1 ? 0.5f * (low + cuts.high[line]) : low + share * (cuts.high[line] - low);
      points.s[i] = along_s_ ? places[i] : LineAt<How>(static_cast<int>(line));
      points.t[i] = along_s_ ? LineAt<How>(static_cast<int>(line)) : places[i];
    }
    const Arriving arriving = sampler_.Trace(patch_, points);
    if (!How::kAlwaysProbes && step == 0 && !Note(points, arriving)) return false;
    for (int i = 0; i < kLanes; ++i) {
      const auto line = static_cast<size_t>(i / kPoints);
      const uint32_t key = arriving.key[i];
      const bool is_known = key == things_[0].key || key == things_[1].key;
      if (!is_known &&
          (cuts.high[line] - cuts.low[line] > How::kSliverIn || places[i] > cuts.high[line])) {
        return false;
      }
      // On a line whose ends see the same nothing else may turn up.
      if (begins[line] == ends[line] && key != begins[line]) return false;
      if (key != first_) {
        cuts.high[line] = std::min(cuts.high[line], places[i]);
      } else if (places[i] < cuts.high[line]) {
        cuts.low[line] = places[i];
      } else {
        return false;
      }
    }
    return true;
  }

  // Positions of the edge on the lines and at both ends of the pixel, to which it is extrapolated.
  std::array<float, kLines + 2> EdgeAcross() const {
    std::array<float, kLines + 2> places;
    std::copy(edge_.begin(), edge_.end(), places.begin() + 1);
    places.front() = 1.5f * edge_[0] - 0.5f * edge_[1];
    places.back() = 1.5f * edge_[kLines - 1] - 0.5f * edge_[kLines - 2];
    return places;
  }

  // Whether all samples lie on their own side of the edge.
  bool Agrees() const {
    const auto places = EdgeAcross();
    for (size_t n = 0; n < sighting_count_; ++n) {
      const Sighting& seen = sightings_[n];
      const float along = along_s_ ? seen.s : seen.t;
      const float across = (along_s_ ? seen.t : seen.s) * static_cast<float>(kLines);
      const int line = std::clamp(static_cast<int>(across), 0, kLines - 1);
      // On this line and its neighbours.
      const auto first = places.begin() + line;
      const auto [nearest, farthest] = std::minmax({first[0], first[1], first[2]});
      if (along < nearest - kNear && seen.key != first_) return false;
      if (along > farthest + kNear && seen.key == first_) return false;
    }
    return true;
  }

  using Areas = std::array<float, 4>;  // Of each quarter, in the order of QuarterImages.

  Areas AreasOfThing0() const {
    Areas areas{};
    for (size_t i = 0; i < kLines; ++i) {
      const size_t across = i < kLines / 2 ? 0 : 1;
      for (const size_t along : {0u, 1u}) {
        const float covered = std::clamp(2.0f * edge_[i] - static_cast<float>(along), 0.0f, 1.0f);
        areas[along_s_ ? 2 * across + along : 2 * along + across] += covered;
      }
    }
    constexpr size_t kLinesEachWay = kLines / 2;
    for (float& area : areas) {
      area /= static_cast<float>(kLinesEachWay);
      if (first_ != things_[0].key) area = 1.0f - area;
    }
    return areas;
  }

  Film::QuarteredResult Result(const Areas& of_thing_0, uint32_t key) const {
    Film::QuarteredResult result;
    result.key = key;
    for (size_t q = 0; q < of_thing_0.size(); ++q) {
      const std::array<float, 2> areas = {of_thing_0[q], 1.0f - of_thing_0[q]};
      for (size_t c = 0; c < sampler_.channel_count(); ++c) {
        for (size_t k = 0; k < thing_count_; ++k) {
          result.quarters[q][c] +=
              areas[k] * things_[k].radiance_sum[c] / static_cast<float>(things_[k].count);
        }
      }
    }
    return result;
  }

  const PixelSampler& sampler_;
  Film::Pixel pixel_;
  PixelPatches patch_;
  std::array<Thing, 2> things_;
  size_t thing_count_ = 0;
  std::array<Sighting, How::kProbes + kLanes + kBorders * kLines> sightings_;
  size_t sighting_count_ = 0;
  std::array<Keys, kBorders> border_keys_;  // Left, right, top, bottom.
  bool along_s_ = true;
  uint32_t first_ = 0;  // The thing before the edge.
  Places edge_;         // Where each line meets the edge: 0 or 1 if it does not.
};

}  // namespace

std::optional<Film::QuarteredResult> SearchEdge(EdgeLines lines, const PixelSampler& sampler,
                                                Film::Pixel pixel, const Film::PixelResult& known) {
  if (lines == EdgeLines::kFour) return EdgeSearch<Quick>(sampler, pixel).Run(known);
  return EdgeSearch<Fine>(sampler, pixel).Run(known);
}

}  // namespace fenestra

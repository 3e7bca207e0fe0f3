#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "renderers/tracing/packet.h"
#include "scenes/lighting.h"

namespace fenestra {

/// Directions to points that are spread evenly over the sun's disc, for packets of shadow rays.
///
/// Lane i of turn j has Sobol point 16 i + (2 i xor j) of 256, stretched over the disc by r = √u,
/// φ = 2π v; 2 i is formed in the field of sixteen elements. So the sixteen turns of a lane and the
/// sixteen lanes of a turn are both stratified in u and in v, and no point occurs twice.
class SunPoints {
 public:
  static constexpr int kTurns = kLanes;
  /// The turn whose points are on the disc's rim, which what hides a part of it hides first.
  static constexpr int kRim = kTurns;

  explicit SunPoints(const Sun& sun);

  /// Whether the sun has no extent.
  bool is_point() const { return is_point_; }

  struct Choice {
    int turn = 0;   ///< In [0, kTurns), or kRim.
    int shift = 0;  ///< In [0, kLanes): lane i has the points of lane i xor shift.
  };

  /// Directs the rays to their points.
  void Aim(const Choice& choice, RTCRay16& rays) const;

 private:
  bool is_point_;
  std::array<Directions, kTurns + 1> turns_W_;
};

}  // namespace fenestra

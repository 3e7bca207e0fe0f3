#pragma once

#include <array>

#include "renderers/lit_surfaces.h"
#include "renderers/packet.h"

namespace fenestra {

/// The loops over lanes that every ray goes through, compiled for the widest vectors at hand.

/// Bilinear interpolation of a pixel's corner rays, in normalised image coordinates and per lane:
/// (x, y) = c00 + s (c10 − c00) + t (c01 − c00) + s t (c00 − c10 − c01 + c11).
struct PixelPatch {
  float x0, xs, xt, xst;
  float y0, ys, yt, yst;
};

/// Columns of R_WC in single precision.
struct CameraAxes {
  glm::vec3 right_W;
  glm::vec3 down_W;
  glm::vec3 forward_W;
};

/// A camera's place and axes, converted once.
struct FloatPose {
  glm::vec3 p_WC;
  CameraAxes axes;
};

FloatPose ToFloat(const Pose& X_WC);

/// Directions x right + y down + forward, not normalised: a hit's t is its depth along the optical
/// axis.
Directions ToWorld(const CameraAxes& axes, const Lanes<float>& x, const Lanes<float>& y);

/// The image coordinates of sixteen samples (s, t) in [0, 1)² of one pixel: scrambled points from
/// kNetTable.
struct ImagePoints {
  Lanes<float> x;
  Lanes<float> y;
};
ImagePoints SamplePatch(const PixelPatch& patch, const uint32_t* net_x, const uint32_t* net_y,
                        uint32_t scramble_x, uint32_t scramble_y);

/// The side that each lane hit, or the sky or the ground: an index into SideRadiance tables.
Lanes<uint32_t> SidesHit(const RayPacket& packet, uint32_t triangle_count);

/// The two parts of the light that leaves each hit.
struct LaneLight {
  Lanes<float> ambient;
  Lanes<float> sun;  ///< If the sun reaches the hit.
};
LaneLight LightLeaving(const SideRadiance* sides, const Lanes<uint32_t>& side_hit,
                       const RayPacket& packet);

/// Rays from all hits towards a distant light, starting `offset_m` off the surface on the side
/// that the packet's rays came from.
RTCRay16 RaysFromHits(const RayPacket& packet, float offset_m, const glm::vec3& direction_W);

/// table[index[i]] of each lane.
Lanes<uint32_t> LookUp(const uint32_t* table, const Lanes<uint32_t>& index);

}  // namespace fenestra

#pragma once

#include "core/geometry/pose.h"
#include "renderers/tracing/packet.h"
#include "renderers/tracing/sobol_samples.h"

namespace fenestra {

/// The loops over lanes that every ray goes through, compiled for the widest vectors at hand.

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

/// Places in an image, as normalised image coordinates.
struct ImagePoints {
  Lanes<float> x;
  Lanes<float> y;
};

/// Places (s, t) in [0, 1]² within pixels, from their top left corners.
struct PixelPoints {
  Lanes<float> s;
  Lanes<float> t;
};

/// Pixels are sampled in square blocks of this many to a side: a lane for each pixel, row by row.
inline constexpr int kBlockSide = 4;
static_assert(kBlockSide * kBlockSide == kLanes);

struct PixelBlock {
  Lanes<uint32_t> corner;  ///< Index of each pixel's top left corner: see PatchesOf.
  Lanes<uint32_t> seed_x;  ///< Seeds for ScrambledPoints.
  Lanes<uint32_t> seed_y;
};

/// `corner` and `index` are those of the block's top left pixel; `stride` corners and `width`
/// pixels are in a row of the image.
PixelBlock MakePixelBlock(uint32_t corner, uint32_t stride, uint32_t index, uint32_t width,
                          const ImageScramble& scramble);

/// Sobol points (see SobolTable) scrambled with each lane's seeds.
PixelPoints ScrambledPoints(const Lanes<uint32_t>& net_x, const Lanes<uint32_t>& net_y,
                            const Lanes<uint32_t>& seed_x, const Lanes<uint32_t>& seed_y);

/// Bilinear interpolation between the corner rays of each lane's pixel:
/// (x, y) = c00 + s (c10 − c00) + t (c01 − c00) + s t (c00 − c10 − c01 + c11).
struct PixelPatches {
  Lanes<float> x0, xs, xt, xst;
  Lanes<float> y0, ys, yt, yst;
};

/// `corner` is the index of the pixel's top left corner in RayGrid::corner_data(), `stride` the
/// corners in a row.
PixelPatches PatchesOf(const float* corner_data, const Lanes<uint32_t>& corner, uint32_t stride);

ImagePoints InPixels(const PixelPatches& patches, const PixelPoints& points);

/// The side that each lane hit, or the sky or the ground: see SideIndex.
Lanes<uint32_t> SidesHit(const RayPacket& packet, uint32_t triangle_count);

/// Width of a pixel's area on the surface that was hit [m]: `spread` times the length of the ray,
/// of which `before` is the part before a mirror. The area is stretched by 1/cos, so its side by
/// the root of that.
Lanes<float> PixelWidths(const RayPacket& packet, const Lanes<float>& before, float spread);

/// table[index[i]] of each lane.
Lanes<uint32_t> LookUp(const uint32_t* table, const Lanes<uint32_t>& index);

}  // namespace fenestra

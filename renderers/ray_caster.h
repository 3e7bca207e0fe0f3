#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "core/pose.h"
#include "core/random_stream.h"
#include "renderers/ray_grid.h"
#include "scenes/lighting.h"
#include "scenes/scene.h"

namespace fenestra {

/// What a rendered image measures.
enum class Band {
  kLuminance,  ///< One channel, [cd/m²]: reflectances weighted as Rec. 709 luminance.
  kRgb,        ///< Three channels B, G, R, [cd/m²]: white under E lux has E/π in each channel.
  kInfrared,   ///< One channel, spectral radiance at 830 nm [W/(m² sr nm)].
};

/// On how many lines across a pixel its edge is searched.
enum class EdgeLines {
  kSixteen,  ///< A straight edge is placed to 0.0015 px RMS in each row.
  kFour,     ///< To 0.006 px, with a third of the rays.
};

struct RenderOptions {
  Band band = Band::kLuminance;
  /// Samples of every pixel: 1, 4, 16, 64 or 256.
  int samples_per_pixel = 4;
  /// If this is more than samples_per_pixel, edges (of an object or a shadow) are searched for in
  /// the pixels that they cross (see EdgeLines); and this many
  /// samples go to pixels with more in them than one edge: 256 place edges there to about 0.006 px.
  int edge_samples_per_pixel = 256;
  EdgeLines edge_lines = EdgeLines::kSixteen;
};

/// Four images of one size, of the quarters of their pixels: upper left, upper right, lower left,
/// lower right.
using QuarterImages = std::array<cv::Mat, 4>;

/// Throws InputError, with all faults, unless the sample counts are allowed ones.
void Validate(const RenderOptions& options);

/// Which truths CastAovs fills in besides depth, normal and object.
struct AovOptions {
  /// Per-pixel offsets (du, dv) [px] from the pixel centre; empty: none. Each component in
  /// [-64, 64]; rays that leave the image continue its border's spacing.
  cv::Mat2f offsets_px;
  /// A point whose view of each surface point is tested (a projector), in W.
  std::optional<Eigen::Vector3d> p_WP;
};

/// Per-pixel truth along one ray per pixel, through its centre unless offsets say otherwise.
/// Surfaces behind a pane of glass are seen through it; `transmittance` says how much light passes.
struct AovImages {
  cv::Mat1f depth_m;    ///< Along the optical axis to the first opaque surface; NaN: none.
  cv::Mat3f normal_C;   ///< Geometric unit normal in the camera frame, facing the camera; 0: none.
  cv::Mat1i object_id;  ///< Index of the mesh in the scene; -1: none.
  cv::Mat1i material_id;    ///< Index of its material; -1: none.
  cv::Mat1b sees_sun;       ///< 255 where the sun reaches the surface (0 if there is no sun).
  cv::Mat1b sees_point;     ///< 255 where the point p_WP is in sight; empty without p_WP.
  cv::Mat1f transmittance;  ///< Of the glass between camera and surface, [0, 1].
  cv::Mat1f reflectance_830nm;
  cv::Mat1f irradiance_lx;   ///< Illuminance of the surface, by all lights [lx].
  cv::Mat1f irradiance_830;  ///< By all lights, on the surface [W/(m² nm)].
};

enum class InstructionSet { kBest, kAvx2, kSse42 };

struct RayCasterOptions {
  /// Diffuse reflections that light goes through before it reaches what is seen. The rest that is
  /// left out is at most ρ^(bounces + 1) of the light in a closed white room of reflectance ρ.
  int bounces = 16;
  /// What Embree may use of this machine. Fenestra's own kernels round alike on all of them;
  /// Embree's hits differ in their last bits. See docs/performance.md.
  InstructionSet instruction_set = InstructionSet::kBest;
};

/// Throws InputError unless bounces is in [0, 1000].
void Validate(const RayCasterOptions& options);

/// An Embree ray caster for one scene. Construction builds the ray tracing structures and bakes,
/// for every vertex, what it sees of the sky, of the ground and of other surfaces; all else depends
/// on the arguments of the calls. Const calls are thread-safe and single-threaded inside.
class RayCaster {
 public:
  explicit RayCaster(const Scene& scene, const RayCasterOptions& options = {});
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  const Scene& scene() const;

  /// Mean radiance over each pixel's area; CV_32FC1 or CV_32FC3, linear in each light. X_WC places
  /// the camera. `sampling` scrambles the sample positions within the pixels.
  cv::Mat Render(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                 const RenderOptions& options, const RandomStream& sampling) const;

  /// The same over each quarter of each pixel, for a point spread that is narrower than a pixel:
  /// such a spread softens the light before pixels gather it, which whole pixels no longer tell.
  QuarterImages RenderQuarters(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                               const RenderOptions& options, const RandomStream& sampling) const;

  AovImages CastAovs(const RayGrid& rays, const Pose& X_WC, const Lighting& lighting,
                     const AovOptions& options) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fenestra

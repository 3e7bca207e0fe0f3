#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

namespace fenestra {

/// The quantity that a rendered image measures.
enum class Band {
  kLuminance,  ///< One channel, [cd/m²]: reflectances weighted as Rec. 709 luminance.
  kRgb,        ///< Three channels B, G, R, [cd/m²]: white under E lux has E/π in each channel.
  kInfrared,   ///< One channel, spectral radiance at 830 nm [W/(m² sr nm)].
};

/// Number of lines across a pixel on which its edge is searched.
enum class EdgeLines {
  kSixteen,  ///< A straight edge is placed to 0.0015 px RMS in each row.
  kFour,     ///< A straight edge is placed to 0.006 px, with a third of the rays.
};

struct RenderOptions {
  Band band = Band::kLuminance;
  /// Samples of every pixel: 1, 4, 16, 64 or 256.
  int samples_per_pixel = 4;
  /// If this is more than samples_per_pixel, edges of objects and shadows are searched for in the
  /// pixels that they cross (see EdgeLines). Pixels with more than one edge get this many samples:
  /// 256 place edges there to about 0.006 px.
  int edge_samples_per_pixel = 256;
  EdgeLines edge_lines = EdgeLines::kSixteen;
};

/// Four images of one size, one for each quarter of the pixels: upper left, upper right, lower
/// left, lower right.
using QuarterImages = std::array<cv::Mat, 4>;

/// The truths that CastAovs fills in besides depth, normal and object.
struct AovOptions {
  /// Per-pixel offsets (du, dv) [px] from the pixel centre; empty: none. Each component in
  /// [-64, 64]; rays that leave the image continue its border's spacing.
  cv::Mat2f offsets_px;
  /// A point whose view of each surface point is tested (a projector), in W.
  std::optional<Eigen::Vector3d> p_WP;
};

/// Per-pixel truth along one ray per pixel, through its centre unless there are offsets. Surfaces
/// behind a pane of glass are seen through it; `transmittance` is the share of light that passes.
struct AovImages {
  cv::Mat1f depth_m;    ///< Along the optical axis to the first opaque surface; NaN: none.
  cv::Mat3f normal_C;   ///< Geometric unit normal in the camera frame, facing the camera; 0: none.
  cv::Mat1i object_id;  ///< Index of the mesh in the scene; -1: none.
  cv::Mat1i material_id;  ///< Index of its material; -1: none.
  cv::Mat1b sees_sun;    ///< 255 where a part of the sun's disc is in sight (0 if there is no sun).
  cv::Mat1b sees_point;  ///< 255 where the point p_WP is in sight; empty without p_WP.
  cv::Mat1f transmittance;  ///< Transmittance of the glass before the surface, [0, 1].
  cv::Mat1f reflectance_830nm;
  cv::Mat1f irradiance_lx;   ///< Illuminance of the surface, by all lights [lx].
  cv::Mat1f irradiance_830;  ///< Spectral irradiance by all lights [W/(m² nm)].
};

enum class InstructionSet { kBest, kAvx2, kSse42 };

}  // namespace fenestra

#pragma once

#include <Eigen/Core>
#include <optional>

#include "experiments/cramer_rao/blurred_edge.h"
#include "experiments/cramer_rao/pixel_noise.h"

namespace fenestra {

/// Unknowns of a line of pixels that crosses a frame's border: where its outer and its inner edge
/// are, inwards along their normals [px]; the blur [px]; how bright wall, frame and opening are
/// [e].
inline constexpr int kBorderUnknowns = 6;
using BorderInformation = Eigen::Matrix<double, kBorderUnknowns, kBorderUnknowns>;

/// Photo-electrons of a pixel.
struct BorderLevels {
  double wall_e = 0.0;
  double frame_e = 0.0;
  double opening_e = 0.0;
};

/// An edge where a line of pixels crosses it.
struct EdgeCrossing {
  const BlurredEdge& edge;
  double place;  ///< Along the line: pixel i has its centre at i.
  double slant;  ///< Component along the line of the edge's inward unit normal; not 0.
};

/// A line of pixels, from `first` to `last`.
struct BorderLine {
  EdgeCrossing outer;
  std::optional<EdgeCrossing> inner;  ///< None near the corners, where the line stays on the frame.
  /// How far beyond the edges' blur, outside and inside, pixels tell how bright it is there [px].
  double margin_px;
  int first;
  int last;
};

/// The information of that line. Pixel i expects
///
///     μ = W + (F - W) S_outer(d) + (O - F) S_inner(d).
///
/// Pixels beside the edges, all of one brightness, count together; saturated ones not at all.
BorderInformation InformationOf(const BorderLine& line, const BorderLevels& levels,
                                const PixelNoise& noise);

}  // namespace fenestra

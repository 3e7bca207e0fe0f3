#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace fenestra {

/// Approximate place of a chessboard corner and directions of its two edges.
struct CornerGuess {
  Eigen::Vector2d pixel;
  Eigen::Vector2d along_row;     ///< Direction of one edge; any length.
  Eigen::Vector2d along_column;  ///< Direction of the other edge; not parallel to the first.
  double radius_px;              ///< Radius of a window that contains no other corner.
};

/// Finds the point q where two blurred edges cross, by least squares over a round window:
///
///     I(x) = a + g·(x - q) + b erf(n₁·(x - q)/(√2 s)) erf(n₂·(x - q)/(√2 s))
///
/// with unknowns q, the directions of the normals n₁ and n₂, the blur s, grey level a, contrast b
/// and shading g, and with weights 1 - |x - q|²/R². The product is exact for perpendicular edges
/// and a Gaussian blur; for other edges its error is symmetric about q, which does not move the
/// minimum. (cv::cornerSubPix interpolates grey values, which moves corners by up to a tenth of a
/// pixel if the edges are as sharp as a good lens makes them.)
///
/// Returns nullopt if the window leaves the image, if the iteration does not converge within a
/// radius of the guess, or if there is no contrast.
std::optional<Eigen::Vector2d> RefineCorner(const cv::Mat1b& image, const CornerGuess& guess);

}  // namespace fenestra

#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace fenestra {

/// Where a corner of a chessboard is thought to be, and how its two edges run.
struct CornerGuess {
  Eigen::Vector2d pixel;
  Eigen::Vector2d along_row;     ///< Direction of one edge; any length.
  Eigen::Vector2d along_column;  ///< Of the other one; not parallel to the first.
  double radius_px;              ///< Of the window that holds nothing but this corner.
};

/// Finds the point q where two blurred edges cross, by least squares over a round window:
///
///     I(x) = a + g·(x - q) + b erf(n₁·(x - q)/(√2 s)) erf(n₂·(x - q)/(√2 s))
///
/// with unknowns q, the directions of the normals n₁ and n₂, the blur s, grey level a, contrast b
/// and shading g; weights 1 - |x - q|²/R². The product is exact for edges at right angles and a
/// Gaussian blur; for others it departs from the truth symmetrically about q, which does not move
/// the minimum. (cv::cornerSubPix interpolates grey values, which moves corners by up to a tenth
/// of a pixel where edges are as sharp as a good lens makes them.)
///
/// nullopt if the window leaves the image, the iteration does not settle within a radius of the
/// guess, or there is no contrast.
std::optional<Eigen::Vector2d> RefineCorner(const cv::Mat1b& image, const CornerGuess& guess);

}  // namespace fenestra

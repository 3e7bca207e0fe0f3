#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/detection/quadrilateral.h"

namespace fenestra {

struct DarknessSettings {
  double black_dn;         ///< Grey value without light.
  double min_contrast_dn;  ///< Smaller differences count as none.
  double reach_px;         ///< Grey values are compared up to this distance on either side.
};

/// Measures how clearly the directed line from `from` to `to` separates dark on its right from
/// bright on its left: the mean over places along the line of ln(bright / dark) / ln 4, limited to
/// 1, and 0 where the right side is not darker. Places outside the image count as 0.
double DarkOnTheRight(const cv::Mat1b& image, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to, const DarknessSettings& settings);

/// Measures how clearly a quadrilateral is darker than its surroundings: the mean of DarkOnTheRight
/// over its sides.
double DarkInside(const cv::Mat1b& image, const Quadrilateral& corners_px,
                  const DarknessSettings& settings);

/// Ratio of the grey value just inside an outline to that just outside it, both above the black
/// level: the median over places along the outline, at least 0. Returns 1 if no part of the outline
/// is in the image.
double DarkOverBright(const cv::Mat1b& image, const std::vector<Eigen::Vector2d>& outline,
                      const DarknessSettings& settings);

/// Tells whether a single grey value separates the inside from the outside all around the
/// quadrilateral. It does for a frame, which has one paint, but rarely for the area between four
/// unrelated edges. An eighth of the places on either side of the border may be exceptions, to
/// allow for objects in front of it.
bool IsDarkThroughout(const cv::Mat1b& image, const Quadrilateral& corners_px,
                      const DarknessSettings& settings);

}  // namespace fenestra

#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/frame/quadrilateral.h"

namespace fenestra {

struct DarknessSettings {
  double black_dn;         ///< Grey value without light.
  double min_contrast_dn;  ///< What is darker by less is not darker.
  double reach_px;         ///< Grey values are compared up to here on either side of an edge.
};

/// How clearly a line parts dark on the right of who walks along it from bright on the left: mean
/// over places along it of ln(bright / dark) / ln 4, at most 1, 0 where it is not darker. Places
/// outside the image count as 0.
double DarkOnTheRight(const cv::Mat1b& image, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to, const DarknessSettings& settings);

/// Mean of that over the sides of a quadrilateral: how clearly it is darker than what surrounds it.
double DarkInside(const cv::Mat1b& image, const Quadrilateral& corners_px,
                  const DarknessSettings& settings);

/// Grey value within an outline over that outside of it, above the black level: the median over
/// places along the outline's sides, from 0. 1 where nothing of it is in the image.
double DarkOverBright(const cv::Mat1b& image, const std::vector<Eigen::Vector2d>& outline,
                      const DarknessSettings& settings);

/// Whether one grey value parts what is within its sides from what is outside of them, all around:
/// a frame is of one paint. What four unrelated edges enclose is not, as a rule. An eighth of the
/// places on either side of the border may be exceptions, for what stands before it.
bool IsDarkThroughout(const cv::Mat1b& image, const Quadrilateral& corners_px,
                      const DarknessSettings& settings);

}  // namespace fenestra

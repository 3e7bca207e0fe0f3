#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/geometry/pose.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// A frame as it truly stands before the scored camera C: two rectangles with one centre in the
/// plane z = 0 of frame O (+x to the right, +y up). Its unknowns, in this order: the centroid p_CO
/// [m]; a turn δ about it, R = exp(δ) R_CO [rad]; width, height and border [m].
struct FrameState {
  Pose X_CO;
  double width_m;
  double height_m;
  double border_m;  ///< From the outer rectangle to the inner one.

  static FrameState Of(const WindowTruth& window, double border_m);
};

inline constexpr int kFrameUnknowns = 9;
inline constexpr int kCentroidUnknowns = 3;
inline constexpr int kWidthUnknown = 6;
inline constexpr int kHeightUnknown = 7;

/// A point on one of the rectangles in C, and its derivatives by the frame's unknowns.
struct FramePoint {
  Eigen::Vector3d p_CQ;
  Eigen::Matrix<double, 3, kFrameUnknowns> by_frame;
};

enum class FrameEdge { kOuter, kInner };

/// `place`: (-1, -1) is the rectangle's bottom left, (1, 1) its top right.
FramePoint PointOn(const FrameState& frame, FrameEdge edge, const Eigen::Vector2d& place);

/// What an estimate knows of a window frame and of its sensor before it sees any image.
struct PriorKnowledge {
  /// Standard deviation of width and height around what is expected [m]; nullopt: not expected.
  std::optional<double> size_sigma_m = {};
  /// Covariance of the nominal calibration's error: PairMatrix for stereo, UnitCovariance for
  /// RGB-D; nullopt: it is the truth.
  std::optional<Eigen::MatrixXd> calibration = {};
  /// RGB-D: standard deviation of how far the wall's face stands before the front of the frame,
  /// around what is expected [m]; nullopt: known.
  std::optional<double> wall_sigma_m = {};
};

/// Adds the prior on width and height to information whose first unknowns are a window frame's.
Eigen::MatrixXd WithSizePrior(const Eigen::MatrixXd& information, const PriorKnowledge& knowledge);

/// Cramér and Rao's bound: an unbiased estimate of unknowns θ from data x has a covariance of at
/// least F⁻¹, where F = E[∂ln p/∂θ ∂ln p/∂θᵀ] is the data's Fisher information. For independent
/// normal pixels of mean μ and variance V,
///
///     F = Σ ∂μ ∂μᵀ/V + ½ ∂V ∂Vᵀ/V².
///
/// Prior knowledge of an unknown, with variance s², adds 1/s² to F (the bound of H. L. Van
/// Trees, "Detection, Estimation, and Modulation Theory I", 1968, section 2.4, for normal priors).

/// The covariance bound of the first `count` unknowns, all others being unknown too. Unknowns that
/// the data tell nothing about and that nothing depends on count for nothing. nullopt if the data
/// do not determine the first ones. Information: symmetric, n x n; count ≤ n.
std::optional<Eigen::MatrixXd> CramerRaoBound(const Eigen::MatrixXd& information, int count);

/// Information on fewer unknowns: those from `first` on, `covariance` of them, are nuisance that is
/// known beforehand with this covariance, which may be singular: L ζ with ζ ~ N(0, 1) and
/// L Lᵀ = covariance stand in their place, at the end of the unknowns.
Eigen::MatrixXd WithNuisance(const Eigen::MatrixXd& information, Eigen::Index first,
                             const Eigen::MatrixXd& covariance);

/// Information with `count` unknowns from `first` on known exactly: their rows and columns go.
Eigen::MatrixXd WithKnown(const Eigen::MatrixXd& information, Eigen::Index first,
                          Eigen::Index count);

}  // namespace fenestra

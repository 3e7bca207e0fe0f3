#pragma once

#include <Eigen/Core>
#include <optional>

namespace fenestra {

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

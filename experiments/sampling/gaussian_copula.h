#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "experiments/study/sampling_design.h"

namespace fenestra {

/// The joint distribution of uniform variates U_i = Φ(Y_i) with Y normal of covariance R, whose
/// entries make Spearman's rank correlations the given ones:
///
///     R_ij = 2 sin(π ρ_ij / 6)
///
/// Rank correlations are kept by every increasing map, so factors drawn as quantiles of the U_i
/// have exactly these, whatever their distributions.
/// Source: W. H. Kruskal, "Ordinal measures of association", JASA 53, 1958, for R;
/// R. B. Nelsen, "An Introduction to Copulas", 2nd ed. 2006, for the copula.
class GaussianCopula {
 public:
  /// Correlations between pairs of `names`; pairs that name anything else are left out. nullopt
  /// where no joint distribution has these correlations: R is not positive definite.
  static std::optional<GaussianCopula> Of(std::span<const std::string> names,
                                          std::span<const FactorCorrelation> correlations);

  /// From independent uniform variates to correlated ones, by the Cholesky factor L of R:
  /// u_i ↦ Φ(Σ_j L_ij Φ⁻¹(u_j)). The first is kept; so are those that nothing is correlated with.
  Eigen::VectorXd Correlated(const Eigen::VectorXd& independent) const;

  bool independent() const { return independent_; }

 private:
  GaussianCopula(Eigen::MatrixXd cholesky, bool independent)
      : cholesky_(std::move(cholesky)), independent_(independent) {}

  Eigen::MatrixXd cholesky_;
  bool independent_;
};

}  // namespace fenestra

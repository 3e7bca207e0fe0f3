#include "experiments/sampling/gaussian_copula.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "core/system/check.h"

namespace fenestra {
namespace {

// L_ii² is the share of a score's variance that the scores before it do not explain. With less than
// this the factor is a function of the others, and R is singular but for rounding.
constexpr double kLeastDiagonal = 1e-6;

double NormalQuantile(double u) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * u);
}

double NormalProbability(double z) {
  return 0.5 * boost::math::erfc(-z / std::numbers::sqrt2);
}

std::optional<Eigen::Index> IndexOf(std::span<const std::string> names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return found - names.begin();
}

}  // namespace

std::optional<GaussianCopula> GaussianCopula::Of(std::span<const std::string> names,
                                                 std::span<const FactorCorrelation> correlations) {
  const auto n = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n);
  bool independent = true;
  for (const FactorCorrelation& correlation : correlations) {
    const auto i = IndexOf(names, correlation.first);
    const auto j = IndexOf(names, correlation.second);
    if (!i || !j) continue;
    FENESTRA_CHECK(*i != *j && std::abs(correlation.spearman) < 1.0, correlation.first);
    normal(*i, *j) = normal(*j, *i) = 2.0 * std::sin(std::numbers::pi / 6 * correlation.spearman);
    independent = false;
  }
  const Eigen::LLT<Eigen::MatrixXd> factorisation(normal);
  if (factorisation.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd cholesky = factorisation.matrixL();
  if (n > 0 && cholesky.diagonal().minCoeff() < kLeastDiagonal) return std::nullopt;
  return GaussianCopula(cholesky, independent);
}

Eigen::VectorXd GaussianCopula::Correlated(const Eigen::VectorXd& independent) const {
  FENESTRA_CHECK(independent.size() == cholesky_.rows(), "one number for each factor");
  if (independent_) return independent;
  const Eigen::VectorXd scores = independent.unaryExpr(&NormalQuantile);
  Eigen::VectorXd correlated = independent;
  for (Eigen::Index i = 0; i < independent.size(); ++i) {
    if (cholesky_(i, i) == 1.0) continue;  // Through Φ⁻¹ and Φ a number would lose digits.
    double sum = 0.0;
    for (Eigen::Index j = 0; j <= i; ++j) sum += cholesky_(i, j) * scores[j];
    correlated[i] = NormalProbability(sum);
  }
  return correlated;
}

}  // namespace fenestra

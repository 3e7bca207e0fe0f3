#include "experiments/cramer_rao/cramer_rao.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace fenestra {
namespace {

// Independent numbers, symmetric and positive.
Eigen::MatrixXd Information(int unknowns) {
  Eigen::MatrixXd a(unknowns, unknowns);
  for (int i = 0; i < a.size(); ++i) a.data()[i] = std::sin(3.0 * i + 1.0);
  return a * a.transpose() + 0.5 * Eigen::MatrixXd::Identity(unknowns, unknowns);
}

TEST(CramerRaoTest, TheBoundIsTheInverseInAnyUnits) {
  const Eigen::MatrixXd information = Information(5);
  const Eigen::MatrixXd bound = CramerRaoBound(information, 3).value();
  EXPECT_TRUE(bound.isApprox(information.inverse().topLeftCorner(3, 3), 1e-12));
  Eigen::VectorXd units(5);
  units << 1e-3, 1.0, 1e3, 1e6, 1e-6;
  const Eigen::MatrixXd scaled = units.asDiagonal() * information * units.asDiagonal();
  const Eigen::VectorXd back = units.head(3).cwiseInverse();
  EXPECT_TRUE(CramerRaoBound(scaled, 3).value().isApprox(
      back.asDiagonal() * bound * back.asDiagonal(), 1e-9));
}

TEST(CramerRaoTest, WhatDataDoNotTellHasNoBoundUnlessNothingDependsOnIt) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(4, 4);
  information.topLeftCorner(3, 3) = Information(3);
  EXPECT_TRUE(CramerRaoBound(information, 3).has_value());
  EXPECT_FALSE(CramerRaoBound(information, 4).has_value());
  // Two unknowns of which only the sum is seen.
  const Eigen::Vector3d seen(1.0, 1.0, 0.0);
  EXPECT_FALSE(CramerRaoBound(seen * seen.transpose(), 1).has_value());
}

TEST(CramerRaoTest, NuisanceOfCertainValueIsKnownAndOfAnyValueIsUnknown) {
  const Eigen::MatrixXd information = Information(6);
  const auto bound_with = [&](const Eigen::MatrixXd& covariance) {
    return CramerRaoBound(WithNuisance(information, 2, covariance), 2).value();
  };
  const Eigen::MatrixXd known = CramerRaoBound(WithKnown(information, 2, 3), 2).value();
  const Eigen::MatrixXd unknown = CramerRaoBound(information, 2).value();
  EXPECT_TRUE(bound_with(Eigen::MatrixXd::Zero(3, 3)).isApprox(known, 1e-12));
  EXPECT_TRUE(bound_with(1e9 * Eigen::MatrixXd::Identity(3, 3)).isApprox(unknown, 1e-6));
  // In between: the prior's information is added. Correlated, and in very different units.
  Eigen::Vector3d units(1e-4, 1.0, 1e3);
  const Eigen::Matrix3d covariance =
      units.asDiagonal() * Eigen::Matrix3d(Information(3)) * units.asDiagonal();
  Eigen::MatrixXd with_prior = information;
  with_prior.block<3, 3>(2, 2) += covariance.inverse();
  EXPECT_TRUE(bound_with(covariance).isApprox(CramerRaoBound(with_prior, 2).value(), 1e-6));
  // A singular covariance: the third is known.
  Eigen::Matrix3d singular = covariance;
  singular.row(2).setZero();
  singular.col(2).setZero();
  Eigen::MatrixXd reduced = WithKnown(information, 4, 1);
  reduced.block<2, 2>(2, 2) += covariance.topLeftCorner<2, 2>().inverse();
  EXPECT_TRUE(bound_with(singular).isApprox(CramerRaoBound(reduced, 2).value(), 1e-6));
}

}  // namespace
}  // namespace fenestra

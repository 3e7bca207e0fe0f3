#include "experiments/cramer_rao/cramer_rao.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <vector>

#include "core/system/check.h"

namespace fenestra {
namespace {

Eigen::MatrixXd Selected(const Eigen::MatrixXd& matrix, const std::vector<Eigen::Index>& indices) {
  return matrix(indices, indices);
}

// L with L Lᵀ = covariance, one column for each direction that is uncertain.
Eigen::MatrixXd FactorOf(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd deviations = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  // In units of the deviations, so that focal lengths in pixels do not hide angles in radians.
  const Eigen::VectorXd inverse =
      deviations.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * covariance *
                                                              inverse.asDiagonal());
  const Eigen::VectorXd scales = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  constexpr double kNone = 1e-9;
  const Eigen::Index none = (scales.array() <= kNone).count();  // Eigenvalues ascend.
  const Eigen::MatrixXd factor =
      deviations.asDiagonal() * solver.eigenvectors() * scales.asDiagonal();
  return factor.rightCols(scales.size() - none);
}

}  // namespace

FrameState FrameState::Of(const WindowTruth& window, double border_m) {
  Eigen::Matrix3d R_CO;
  R_CO.col(0) = (window.p_CV[1] - window.p_CV[0]).normalized();
  R_CO.col(2) = window.normal_C;
  R_CO.col(1) = R_CO.col(2).cross(R_CO.col(0));
  return {.X_CO = Pose(R_CO, window.p_CO),
          .width_m = window.width_m,
          .height_m = window.height_m,
          .border_m = border_m};
}

FramePoint PointOn(const FrameState& frame, FrameEdge edge, const Eigen::Vector2d& place) {
  const bool inner = edge == FrameEdge::kInner;
  const double inset_m = inner ? frame.border_m : 0.0;
  const Eigen::Vector3d p_OQ(place.x() * (0.5 * frame.width_m - inset_m),
                             place.y() * (0.5 * frame.height_m - inset_m), 0.0);
  const Eigen::Matrix3d& R_CO = frame.X_CO.rotation();
  FramePoint point{.p_CQ = frame.X_CO * p_OQ, .by_frame = {}};
  point.by_frame.leftCols<3>().setIdentity();
  point.by_frame.middleCols<3>(3) = -CrossMatrix(R_CO * p_OQ);
  point.by_frame.col(kWidthUnknown) = 0.5 * place.x() * R_CO.col(0);
  point.by_frame.col(kHeightUnknown) = 0.5 * place.y() * R_CO.col(1);
  point.by_frame.col(8) =
      inner ? Eigen::Vector3d(-R_CO.leftCols<2>() * place) : Eigen::Vector3d::Zero().eval();
  return point;
}

Eigen::MatrixXd WithSizePrior(const Eigen::MatrixXd& information, const PriorKnowledge& knowledge) {
  Eigen::MatrixXd known = information;
  if (!knowledge.size_sigma_m) return known;
  const double prior = 1.0 / (*knowledge.size_sigma_m * *knowledge.size_sigma_m);
  for (const int unknown : {kWidthUnknown, kHeightUnknown}) known(unknown, unknown) += prior;
  return known;
}

std::optional<Eigen::MatrixXd> CramerRaoBound(const Eigen::MatrixXd& information, int count) {
  FENESTRA_CHECK(count <= information.rows(), "more unknowns wanted than there are");
  std::vector<Eigen::Index> known_of;
  for (Eigen::Index i = 0; i < information.rows(); ++i) {
    if (information(i, i) > 0.0) known_of.push_back(i);
    if (i < count && !(information(i, i) > 0.0)) return std::nullopt;
  }
  const Eigen::MatrixXd kept = Selected(information, known_of);
  // Unit diagonal: metres, radians and electrons on one scale.
  const Eigen::VectorXd scale = kept.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> solver(scale.asDiagonal() * kept * scale.asDiagonal());
  constexpr double kSingular = 1e-13;
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > kSingular)) {
    return std::nullopt;
  }
  const Eigen::MatrixXd wanted = Eigen::MatrixXd::Identity(kept.rows(), count);
  const Eigen::MatrixXd inverse = solver.solve(wanted).topRows(count);
  const Eigen::VectorXd head = scale.head(count);
  return Eigen::MatrixXd(head.asDiagonal() * (0.5 * (inverse + inverse.transpose())) *
                         head.asDiagonal());
}

Eigen::MatrixXd WithNuisance(const Eigen::MatrixXd& information, Eigen::Index first,
                             const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd factor = FactorOf(covariance);
  const Eigen::Index before = first;
  const Eigen::Index replaced = covariance.rows();
  const Eigen::Index after = information.rows() - first - replaced;
  // Old unknowns by new ones: those before, those after, ζ.
  Eigen::MatrixXd by_new =
      Eigen::MatrixXd::Zero(information.rows(), before + after + factor.cols());
  by_new.topLeftCorner(before, before).setIdentity();
  by_new.block(first + replaced, before, after, after).setIdentity();
  by_new.block(first, before + after, replaced, factor.cols()) = factor;
  Eigen::MatrixXd result = by_new.transpose() * information * by_new;
  result.diagonal().tail(factor.cols()).array() += 1.0;
  return result;
}

Eigen::MatrixXd WithKnown(const Eigen::MatrixXd& information, Eigen::Index first,
                          Eigen::Index count) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < information.rows(); ++i) {
    if (i < first || i >= first + count) kept.push_back(i);
  }
  return Selected(information, kept);
}

}  // namespace fenestra

#include "vision/frame/model/frame_prior.h"

#include <cmath>

namespace fenestra {
namespace {

// A parameter with a prior.
struct Known {
  int parameter;
  double value;
  double sigma;
};

std::vector<Known> AllKnown(const FramePrior& prior) {
  std::vector<Known> known;
  if (prior.size) {
    known.push_back({6, prior.size->width_m, prior.size->sigma_m});
    known.push_back({7, prior.size->height_m, prior.size->sigma_m});
  }
  if (prior.outer_relief) {
    for (int i = 9; i < 13; ++i) {
      known.push_back({i, prior.outer_relief->mean_m, prior.outer_relief->sigma_m});
    }
  }
  if (prior.inner_relief) {
    known.push_back({13, prior.inner_relief->mean_m, prior.inner_relief->sigma_m});
  }
  return known;
}

double ValueOf(const FrameRectangle& frame, int parameter) {
  if (parameter == 6) return frame.width_m;
  if (parameter == 7) return frame.height_m;
  if (parameter == 13) return frame.inner_relief_m;
  return frame.outer_relief_m[static_cast<size_t>(parameter - 9)];
}

void AddKnown(const FrameRectangle& frame, const std::vector<Known>& known,
              NormalEquations& equations) {
  for (const Known& k : known) {
    const double information = 1.0 / (k.sigma * k.sigma);
    equations.matrix(k.parameter, k.parameter) += information;
    equations.gradient[k.parameter] += information * (k.value - ValueOf(frame, k.parameter));
  }
}

double LossOfKnown(const FrameRectangle& frame, const std::vector<Known>& known) {
  double sum = 0.0;
  for (const Known& k : known) {
    sum += std::pow((ValueOf(frame, k.parameter) - k.value) / k.sigma, 2);
  }
  return sum;
}

// m as the frame predicts it, minus the measured m.
Eigen::Vector3d PlaneResidual(const FrameRectangle& frame, const PlaneMeasurement& plane) {
  const Eigen::Vector3d normal = frame.R_LO.col(2);
  return normal / (normal.dot(frame.p_LO) + plane.relief_m) - plane.m;
}

void AddPlanes(const FrameRectangle& frame, const std::vector<PlaneMeasurement>& planes,
               double weight, NormalEquations& equations) {
  for (const PlaneMeasurement& plane : planes) {
    const Eigen::Vector3d normal = frame.R_LO.col(2);
    const double q = normal.dot(frame.p_LO) + plane.relief_m;
    Eigen::Matrix3d normal_by_turn;  // R (turn x e_z).
    normal_by_turn << -frame.R_LO.col(1), frame.R_LO.col(0), Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, 6> j;
    j.leftCols<3>() =
        (Eigen::Matrix3d::Identity() - normal * frame.p_LO.transpose() / q) * normal_by_turn / q;
    j.rightCols<3>() = -normal * normal.transpose() / (q * q);
    const Eigen::Matrix<double, 6, 3> weighted = weight * j.transpose() * plane.information;
    equations.matrix.topLeftCorner<6, 6>() += weighted * j;
    equations.gradient.head<6>() -= weighted * PlaneResidual(frame, plane);
  }
}

double LossOfPlanes(const FrameRectangle& frame, const std::vector<PlaneMeasurement>& planes,
                    double weight) {
  double sum = 0.0;
  for (const PlaneMeasurement& plane : planes) {
    const Eigen::Vector3d residual = PlaneResidual(frame, plane);
    sum += weight * residual.dot(plane.information * residual);
  }
  return sum;
}

}  // namespace

void AddPrior(const FrameRectangle& frame, const FramePrior& prior, double plane_weight,
              NormalEquations& equations) {
  AddKnown(frame, AllKnown(prior), equations);
  AddPlanes(frame, prior.planes, plane_weight, equations);
}

double LossOfPrior(const FrameRectangle& frame, const FramePrior& prior, double plane_weight) {
  return LossOfKnown(frame, AllKnown(prior)) + LossOfPlanes(frame, prior.planes, plane_weight);
}

}  // namespace fenestra

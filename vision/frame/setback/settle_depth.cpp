#include "vision/frame/setback/settle_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/frame/setback/frame_setback.h"
#include "vision/frame/setback/upright_edges.h"

namespace fenestra {
namespace {

// Prior of the setback: windows are recessed by up to 10 cm.
constexpr Setback kUnknown{.mean_m = 0.0, .sigma_m = 0.07};
constexpr double kFlush = 0.5;  // Probability, a priori.
// Prior probability of being flush if the opening's edges lie in the rectangle's plane.
constexpr double kFlushIfInOnePlane = 0.99;
// Two views side by side do not determine the depth of horizontal sides, nor of vertical ones for
// which the views see different edges.
constexpr double kUnknownReveal_m = 0.05;
// From this probability of being flush on, a frame counts as flush.
constexpr double kSurelyFlush = 0.95;
// From this probability on, a frame stays where it is, since moving a flush frame would spoil its
// most accurate coordinate.
constexpr double kMayBeFlush = 0.15;
// Error of the model with one front, one reveal and one thickness.
constexpr double kLeastSigma_m = 0.01;
// Parallax error from edges close to each other in the images, common to all measurements.
constexpr double kBlend_px = 0.1;

void MoveBack(FrameFit& fit, const Setback& setback) {
  const Eigen::Vector3d normal = fit.front.R_LO.col(2);
  fit.front.p_LO -= setback.mean_m * normal;
  fit.adjustment.covariance.block<3, 3>(3, 3) +=
      setback.sigma_m * setback.sigma_m * normal * normal.transpose();
}

// Shift of a side's apparent place if it is the edge of the wall, `depth_m` in front of the frame,
// instead of the frame's own. It is zero for sides that are looked at from outside, where the
// wall's edge hides the frame's. p_OC is the camera's position.
double ParallaxOf(const Eigen::Vector3d& p_OC, const FrameRectangle& frame, int axis, double sign,
                  double depth_m) {
  const double half_m = 0.5 * (axis == 0 ? frame.width_m : frame.height_m);
  const double inwards_m = half_m - sign * p_OC[axis];
  return std::max(0.0, inwards_m * depth_m / (p_OC.z() + depth_m));
}

double LeastSigma(std::span<const CameraView> views, const FrameRectangle& frame) {
  if (views.size() != 2) return kLeastSigma_m;
  const Eigen::Vector3d p_LR = views[1].X_CL.inverse().translation();
  const double baseline_m = (p_LR - views[0].X_CL.inverse().translation()).norm();
  const double by_pixel_m =
      frame.p_LO.squaredNorm() / (views[0].camera.parameters().fx_px * baseline_m);
  return std::hypot(kLeastSigma_m, kBlend_px * by_pixel_m);
}

// Centres the frame between the places where its vertical sides are, rather than where they appear
// on its front.
void Centre(const ParallaxEdge& left, const ParallaxEdge& right, FrameFit& fit) {
  FrameRectangle& frame = fit.front;
  frame.p_LO += 0.5 * (left.inset_m - right.inset_m) * frame.R_LO.col(0);
  frame.width_m -= left.inset_m + right.inset_m;
}

}  // namespace

void AddParallax(std::span<const CameraView> views, const SideDepths& depths, FrameFit& fit) {
  const FrameRectangle& frame = fit.adjustment.frame;
  Eigen::Vector3d p_LC = Eigen::Vector3d::Zero();  // A camera midway between the views.
  for (const CameraView& view : views) {
    p_LC += view.X_CL.inverse().translation() / static_cast<double>(views.size());
  }
  const Eigen::Vector3d p_OC = frame.R_LO.transpose() * (p_LC - frame.p_LO);
  for (int axis = 0; axis < 2; ++axis) {
    const double apart_m = axis == 0 ? depths.upright_m : depths.level_m;
    const double off_m = 0.5 * std::hypot(ParallaxOf(p_OC, frame, axis, 1.0, apart_m),
                                          ParallaxOf(p_OC, frame, axis, -1.0, apart_m));
    const Eigen::Vector3d direction = frame.R_LO.col(axis);
    fit.adjustment.covariance.block<3, 3>(3, 3) +=
        off_m * off_m * direction * direction.transpose();
  }
}

void SettleDepth(std::span<const CameraView> views, const RevealGrey& grey, FrameFit& fit) {
  const FrameRectangle& frame = fit.adjustment.frame;
  UprightPair edges;
  if (views.size() == 2) edges = FindUprightEdges(views[0], views[1], frame);
  const std::vector<DepthMeasurement> measurements = edges.Measurements();
  Setback setback = kUnknown;
  if (!measurements.empty()) {
    const double flush = fit.is_in_one_plane && edges.AreInPlane() ? kFlushIfInOnePlane
                                                                   : edges.ProbablyFlush(kFlush);
    const SetbackPosterior posterior = InferSetback(measurements, flush);
    if (posterior.flush > kSurelyFlush && !edges.IsBesideOther()) return;
    setback = posterior.flush > kMayBeFlush ? Setback{0.0, posterior.root_mean_square_m}
                                            : posterior.setback;
    setback.sigma_m = std::max(LeastSigma(views, frame), setback.sigma_m);
  } else if (edges.AreInPlane() && ShowsNoReveal(views, frame, grey)) {
    if (!edges.IsBesideOther()) return;
    setback = {0.0, kLeastSigma_m};
  }
  MoveBack(fit, setback);
  const bool is_centred = !edges.AreInPlane() && edges.AreFarAndNear();
  if (is_centred) Centre(*edges.left.own, *edges.right.own, fit);
  const double depth_m = std::max(setback.mean_m - edges.Foremost(), setback.sigma_m);
  const double blended_m = std::max(depth_m, kUnknownReveal_m);
  AddParallax(
      views,
      {.upright_m = is_centred || edges.AreInPlane() ? depth_m : blended_m, .level_m = blended_m},
      fit);
}

}  // namespace fenestra

#include "vision/frame/setback/settle_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/frame/setback/front_belief.h"
#include "vision/frame/setback/upright_edges.h"

namespace fenestra {
namespace {

// How far frames stand back where nothing tells: windows are set up to 10 cm deep.
constexpr Setback kUnknown{.mean_m = 0.0, .sigma_m = 0.07};
constexpr double kFlush = 0.5;  // Probability, a priori.
// The same if the opening's edges are in the rectangle's plane.
constexpr double kFlushIfInOnePlane = 0.99;
// Two views that are side by side do not tell the depth of level sides, nor of upright ones that
// each view takes from another edge.
constexpr double kUnknownReveal_m = 0.05;
// What has this probability of being flush, is.
constexpr double kSurelyFlush = 0.95;
// What has this one may be, and stays: to move a flush frame would spoil what is known best.
constexpr double kMayBeFlush = 0.15;
// Of a model with one front, one reveal and one thickness.
constexpr double kLeastSigma_m = 0.01;
// Of parallax, what edges that are near each other in the pictures leave in all sights alike.
constexpr double kBlend_px = 0.1;

void MoveBack(FrameFit& fit, const Setback& setback) {
  const Eigen::Vector3d normal = fit.front.R_LO.col(2);
  fit.front.p_LO -= setback.mean_m * normal;
  fit.adjustment.covariance.block<3, 3>(3, 3) +=
      setback.sigma_m * setback.sigma_m * normal * normal.transpose();
}

// Of a side's apparent place, where it may be the frame's or the wall's, `depth_m` before it: on
// sides that are looked at from within; on others the wall's edge hides the frame's. p_OC: of the
// camera.
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

// The frame between where its upright sides are, and not where they seem to be on its front.
void Centre(const ParallaxEdge& left, const ParallaxEdge& right, FrameFit& fit) {
  FrameRectangle& frame = fit.front;
  frame.p_LO += 0.5 * (left.inset_m - right.inset_m) * frame.R_LO.col(0);
  frame.width_m -= left.inset_m + right.inset_m;
}

}  // namespace

void AddParallax(std::span<const CameraView> views, const SideDepths& depths, FrameFit& fit) {
  const FrameRectangle& frame = fit.adjustment.frame;
  Eigen::Vector3d p_LC = Eigen::Vector3d::Zero();  // Of a camera between the views.
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
  const std::vector<DepthSight> sights = edges.Sights();
  Setback setback = kUnknown;
  if (!sights.empty()) {
    const double flush = fit.is_in_one_plane && edges.AreInPlane() ? kFlushIfInOnePlane
                                                                   : edges.ProbablyFlush(kFlush);
    const FrontBelief belief = BelieveFront(sights, flush);
    if (belief.flush > kSurelyFlush && !edges.IsBesideOther()) return;
    setback = belief.flush > kMayBeFlush ? Setback{0.0, belief.root_mean_square_m} : belief.setback;
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

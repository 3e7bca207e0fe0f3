#include "vision/stereo/paper/frame_hypothesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/stereo/paper/window_rectangle.h"

namespace fenestra {
namespace {

constexpr int kProbes = 32;  // Number of probes along a side and across the opening.
// The opening that must be clear: the middle of the frame, so that its border may be up to 30 %
// of its side wide.
constexpr double kOpeningFrom = 0.3;
constexpr double kOpeningTo = 0.7;

// Accuracy of the sides before and after the fattening by the SAD block is undone.
constexpr double kSideShare = 0.2;

// One or two patches.
using Group = std::vector<const MatchedPatch*>;

class DisparityProbe {
 public:
  DisparityProbe(const cv::Mat1f& disparity, const DisparityPlane& plane, double tolerance_px)
      : disparity_(disparity), plane_(plane), tolerance_px_(tolerance_px) {}

  bool OnPlane(int u, int v) const {
    if (u < 0 || v < 0 || u >= disparity_.cols || v >= disparity_.rows) return false;
    const float d = disparity_(v, u);
    return d > 0.0f && std::abs(d - plane_.At({u, v})) <= tolerance_px_;
  }
  bool AnyOnPlane(int u_from, int u_to, int v) const {
    for (int u = u_from; u <= u_to; ++u) {
      if (OnPlane(u, v)) return true;
    }
    return false;
  }

 private:
  const cv::Mat1f& disparity_;
  const DisparityPlane& plane_;
  double tolerance_px_;
};

int Round(double x) {
  return static_cast<int>(std::lround(x));
}

double RowOverlap(const cv::Rect& a, const cv::Rect& b) {
  const int common = std::min(a.br().y, b.br().y) - std::max(a.y, b.y);
  const int either = std::max(a.br().y, b.br().y) - std::min(a.y, b.y);
  return std::max(0, common) / static_cast<double>(either);
}

// Share of a vertical side (s = 0 left, 1 right) with a match on the plane within the width of a
// SAD block.
double SideSupport(const Quadrilateral& q, double s, int window_px, const DisparityProbe& probe) {
  int matched = 0;
  for (int i = 0; i < kProbes; ++i) {
    const Eigen::Vector2d p = At(q, s, (i + 0.5) / kProbes);
    const int u = Round(p.x());
    if (probe.AnyOnPlane(u - window_px, u + window_px, Round(p.y()))) ++matched;
  }
  return matched / static_cast<double>(kProbes);
}

double FilledOpeningRows(const Quadrilateral& q, int window_px, const DisparityProbe& probe) {
  const int fat_px = window_px / 2;  // How far the fattened border extends into the opening.
  int filled = 0;
  for (int i = 0; i < kProbes; ++i) {
    const double t = kOpeningFrom + (kOpeningTo - kOpeningFrom) * (i + 0.5) / kProbes;
    const Eigen::Vector2d from = At(q, kOpeningFrom, t);
    const Eigen::Vector2d to = At(q, kOpeningTo, t);
    const int v = Round(0.5 * (from.y() + to.y()));
    if (probe.AnyOnPlane(Round(from.x()) + fat_px, Round(to.x()) - fat_px, v)) ++filled;
  }
  return filled / static_cast<double>(kProbes);
}

std::optional<FrameHypothesis> Outline(const Group& group) {
  FrameHypothesis hypothesis{.hull = {}, .corners_px = {}, .plane = {}, .patches = group};
  std::vector<cv::Point> points;
  for (const MatchedPatch* patch : group) {
    points.insert(points.end(), patch->hull.begin(), patch->hull.end());
  }
  cv::convexHull(points, hypothesis.hull);
  const auto corners = FitQuadrilateral(hypothesis.hull);
  if (!corners) return std::nullopt;
  hypothesis.corners_px = *corners;
  return hypothesis;
}

// Fits the plane; returns false if the patches do not lie on it.
bool FitPlane(FrameHypothesis& hypothesis, const FrameCriteria& criteria) {
  std::vector<DisparitySample> samples;
  for (const MatchedPatch* patch : hypothesis.patches) {
    samples.insert(samples.end(), patch->samples.begin(), patch->samples.end());
  }
  const auto fit = FitDisparityPlane(samples, criteria.plane_tolerance_px);
  if (!fit || fit->inlier_share < criteria.min_inlier_share) return false;
  hypothesis.plane = fit->plane;
  hypothesis.score = fit->inlier_share;
  return true;
}

// Evaluates a hypothesis whose score so far is the share of its matches on its plane.
std::optional<Miss> Judge(FrameHypothesis& hypothesis, const cv::Mat1f& disparity,
                          const RectifiedCamera& camera, const FrameCriteria& criteria) {
  const Quadrilateral& q = hypothesis.corners_px;
  const auto estimate = WindowOnPlane(q, hypothesis.plane, camera);
  if (!estimate) return Miss{"implausible_shape", "the plane meets the horizon"};
  if (auto objection = ObjectionToShape(*estimate, criteria)) return objection;
  const DisparityProbe probe(disparity, hypothesis.plane, criteria.plane_tolerance_px);
  const double support = std::min(SideSupport(q, 0.0, criteria.window_px, probe),
                                  SideSupport(q, 1.0, criteria.window_px, probe));
  if (support < criteria.min_side_support) {
    return Miss{"implausible_shape",
                fmt::format("only {:.0f} % of a side is matched, {:.0f} % are "
                            "needed",
                            100.0 * support, 100.0 * criteria.min_side_support)};
  }
  const int reach_px = criteria.window_px / 2;
  const auto frame = Inset(q, reach_px);
  if (!frame) return Miss{"implausible_shape", "nothing is left without the SAD window's reach"};
  const double filled = FilledOpeningRows(*frame, criteria.window_px, probe);
  if (filled > criteria.max_opening_rows) {
    return Miss{"implausible_shape",
                fmt::format("{:.0f} % of the opening's rows are matched in the frame's plane",
                            100.0 * filled)};
  }
  hypothesis.score *= support * (1.0 - filled);
  return std::nullopt;
}

// Hypotheses of one or two patches, without planes yet, the largest in the image first.
std::vector<FrameHypothesis> Outlines(const std::vector<Group>& groups) {
  std::vector<FrameHypothesis> outlines;
  for (const Group& group : groups) {
    if (auto outline = Outline(group)) outlines.push_back(std::move(*outline));
  }
  std::stable_sort(outlines.begin(), outlines.end(), [](const auto& a, const auto& b) {
    return Area(a.corners_px) > Area(b.corners_px);
  });
  return outlines;
}

bool CentreIsWithin(const FrameHypothesis& inner, const FrameHypothesis& outer) {
  const Eigen::Vector2d centre = At(inner.corners_px, 0.5, 0.5);
  return cv::pointPolygonTest(outer.hull, cv::Point2f(cv::Point2d(centre.x(), centre.y())),
                              false) >= 0.0;
}

std::vector<Group> Groups(const std::vector<MatchedPatch>& patches, double min_row_overlap) {
  std::vector<Group> groups;
  for (size_t i = 0; i < patches.size(); ++i) {
    groups.push_back({&patches[i]});
    for (size_t j = 0; j < i; ++j) {
      if (RowOverlap(patches[i].box, patches[j].box) >= min_row_overlap) {
        groups.push_back({&patches[i], &patches[j]});
      }
    }
  }
  return groups;
}

}  // namespace

std::optional<Miss> ObjectionToShape(const WindowEstimate& estimate_F,
                                     const FrameCriteria& criteria) {
  const auto implausible = [](const std::string& detail) {
    return Miss{"implausible_shape", detail};
  };
  const double z_m = estimate_F.p_CO.z();
  if (z_m < criteria.nearest_m || z_m > criteria.farthest_m) {
    return implausible(fmt::format("depth {:.2f} m is out of range", z_m));
  }
  const WindowShape shape = MeasureShape(estimate_F.p_CV);
  const double shorter = std::min(shape.width_m, shape.height_m);
  const double longer = std::max(shape.width_m, shape.height_m);
  const std::string size = fmt::format("{:.2f} x {:.2f} m", shape.width_m, shape.height_m);
  if (shorter < criteria.min_side_m || longer > criteria.max_side_m) {
    return implausible(size + " is out of range");
  }
  if (longer > criteria.max_side_ratio * shorter) return implausible(size + " is too slender");
  if (shape.skew_rad > criteria.max_skew_rad || shape.taper > criteria.max_taper) {
    return implausible(
        fmt::format("not a rectangle: corners off by {:.2f} rad, opposite sides by "
                    "{:.0f} %",
                    shape.skew_rad, 100.0 * shape.taper));
  }
  return ObjectionOf(criteria.prior, estimate_F, kSideShare);
}

std::variant<std::vector<FrameHypothesis>, Miss> FindFrames(
    const std::vector<MatchedPatch>& patches, const cv::Mat1f& disparity,
    const RectifiedCamera& camera, const FrameCriteria& criteria, size_t most) {
  std::vector<FrameHypothesis> found;
  std::optional<Miss> objection_to_largest;
  for (FrameHypothesis& hypothesis : Outlines(Groups(patches, criteria.min_row_overlap))) {
    if (found.size() == most) break;
    const bool known = std::any_of(found.begin(), found.end(), [&](const FrameHypothesis& other) {
      return CentreIsWithin(hypothesis, other);
    });
    if (known || !FitPlane(hypothesis, criteria)) continue;
    if (auto objection = Judge(hypothesis, disparity, camera, criteria)) {
      if (!objection_to_largest) objection_to_largest = objection;
      continue;
    }
    found.push_back(std::move(hypothesis));
  }
  if (!found.empty()) {
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    return found;
  }
  if (objection_to_largest) return *objection_to_largest;
  return Miss{"no_component_pair",
              fmt::format("{} matched patches, no two of them in one plane and the same rows",
                          patches.size())};
}

}  // namespace fenestra

#pragma once

#include <vector>

#include "vision/frame/setback/frame_setback.h"

namespace fenestra {

/// A measured depth, behind a rectangle, of some edge of a frame whose front may be behind that
/// rectangle.
struct DepthSight {
  double behind_m;
  double sigma_m;
  /// Whether it may belong to any edge within the frame's thickness, from the front edge to the
  /// rear one, rather than to the front itself.
  bool is_in_thickness;
};

struct FrontBelief {
  double flush;     ///< Probability that the front is in the rectangle's plane.
  Setback setback;  ///< Mean and standard deviation over both cases.
  double root_mean_square_m;
};

/// Posterior of a frame's setback by Bayes' theorem. The prior is flush with the given probability,
/// otherwise uniform up to 20 cm behind the rectangle. If the frame cannot be flush, the rectangle
/// may be a blend of several edges, and the prior also covers 10 cm in front of it. A measurement
/// belongs to the front or to an edge within the frame's thickness, at an unknown depth up to 12 cm
/// behind the front that is common to all of them; one measurement in twenty belongs to something
/// else.
FrontBelief BelieveFront(const std::vector<DepthSight>& sights, double prior_flush);

}  // namespace fenestra

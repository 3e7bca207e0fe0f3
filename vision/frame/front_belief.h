#pragma once

#include <vector>

#include "vision/frame/frame_setback.h"

namespace fenestra {

/// Something whose depth behind a rectangle was measured, on a frame whose front may be behind it.
struct DepthSight {
  double behind_m;
  double sigma_m;
  /// Whether it may be any edge of the frame's thickness, from its front edge to its rear one, and
  /// not the front itself.
  bool is_in_thickness;
};

struct FrontBelief {
  double flush;     ///< Probability that the front is in the rectangle's plane.
  Setback setback;  ///< Mean and standard deviation, whichever it is.
  double root_mean_square_m;
};

/// What sights say of a frame's front, by Bayes. Before: flush with the given probability, or
/// anywhere up to 20 cm behind; if it cannot be flush, the rectangle may be a blend of several
/// edges, and the front up to 10 cm before it. A sight is of the front, or of an edge in the
/// frame's thickness, anywhere up to 12 cm behind it but the same for all; one in twenty is of
/// something else.
FrontBelief BelieveFront(const std::vector<DepthSight>& sights, double prior_flush);

}  // namespace fenestra

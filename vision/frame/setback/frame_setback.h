#pragma once

#include <span>
#include <vector>

#include "vision/frame/measurement/side_request.h"

namespace fenestra {

/// Estimate of how far a frame is recessed behind a rectangle of dark edges, which may be its own
/// outer edges or those of the wall around it.
struct Setback {
  double mean_m;
  double sigma_m;
};

struct RevealGrey {
  double black_dn;         ///< Grey value without light.
  double min_contrast_dn;  ///< Mean grey values along a side that differ by less count as equal.
};

/// Tells whether the views rule out a reveal, i.e. a recess of the frame behind the rectangle. On a
/// side that a camera at distance z looks at from a place h further inwards, a frame at depth d
/// behind the rectangle shows a strip of the reveal of width
///
///     t = h d / (z + d)
///
/// within the rectangle. Returns true if on some side the strip of a reveal 5 cm deep would be wide
/// enough to be seen, and on no side there is a step to something darker, as from a reveal to the
/// frame. There is no such step either where the rectangle is the frame's own edge.
bool ShowsNoReveal(std::span<const CameraView> views, const FrameRectangle& frame,
                   const RevealGrey& grey);

/// A measured depth, behind a rectangle, of some edge of a frame whose front may be behind that
/// rectangle.
struct DepthMeasurement {
  double behind_m;
  double sigma_m;
  /// Whether it may belong to any edge within the frame's thickness, from the front edge to the
  /// rear one, rather than to the front itself.
  bool is_in_thickness;
};

struct SetbackPosterior {
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
SetbackPosterior InferSetback(const std::vector<DepthMeasurement>& measurements,
                              double prior_flush);

}  // namespace fenestra

#pragma once

#include <optional>

#include "renderers/sampling/pixel_sampler.h"

namespace fenestra {

/// The mean radiance of the quarters of a pixel in which at most two things are visible. The edge
/// between them is located instead of sampled: on each of sixteen lines across the pixel its
/// crossing is found by bisection to 1/256 of the line. That gives the area of either thing in each
/// quarter; each counts with the mean radiance of the samples that saw it. A straight edge is thus
/// placed to about 0.001 px. With four lines the crossings are found to 1/125: see EdgeLines.
///
/// `known` is the result of the pixel's first samples, which is returned if there is no edge.
/// Returns nullopt if more than two things are visible, a line is crossed more than once, or the
/// sun's disc is in sight in part, so that its shadow has no edge.
std::optional<Film::QuarteredResult> SearchEdge(EdgeLines lines, const PixelSampler& sampler,
                                                Film::Pixel pixel, const Film::PixelResult& known);

}  // namespace fenestra

#pragma once

#include <optional>

#include "renderers/sampling/pixel_sampler.h"

namespace fenestra {

/// The mean radiance of the quarters of a pixel in which at most two things are seen, with the edge
/// between them found rather than sampled: on each of sixteen lines across the pixel the crossing
/// is searched by bisection to 1/256 of the line, which gives the area of either thing in each
/// quarter; each counts with the mean radiance of the samples that saw it. A straight edge is so
/// placed to about 0.001 px. With four lines, searched to 1/125: see EdgeLines.
///
/// `known` is what the pixel's first samples have seen; it is the result where there is no edge.
/// nullopt where more than two things are seen, or where a line is crossed more than once.
std::optional<Film::QuarteredResult> SearchEdge(EdgeLines lines, const PixelSampler& sampler,
                                                Film::Pixel pixel, const Film::PixelResult& known);

}  // namespace fenestra

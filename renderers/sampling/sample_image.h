#pragma once

#include <opencv2/core.hpp>

#include "core/random/random_stream.h"
#include "renderers/light/light_transport.h"
#include "renderers/sampling/film.h"
#include "renderers/tracing/ray_grid.h"
#include "renderers/tracing/render_types.h"

namespace fenestra {

/// The mean radiance of each pixel's area and of its quarters. All pixels get a few samples. If the
/// samples of a pixel and its eight neighbours have seen different things, the edge between these
/// is searched for (see SearchEdge); pixels with more than one edge get many samples.
///
/// Sample i of a pixel is Sobol point i, scrambled (see sobol_samples.h) by a hash of the stream's
/// key and the pixel's index. So samples of a pixel are stratified along x and along y, and the
/// errors of different pixels are independent.
Film SampleImage(const LightTransport& light, const RayGrid& rays, const FloatPose& camera,
                 const RenderOptions& options, const RandomStream& sampling);

}  // namespace fenestra

#pragma once

#include "renderers/light/light_transport.h"
#include "renderers/tracing/ray_grid.h"
#include "renderers/tracing/render_types.h"

namespace fenestra {

/// Per-pixel truth; see AovImages. `light` has the channels kIlluminance and kIrradiance830. Throws
/// InputError if the offsets' size is not the image's or an offset is outside [-64, 64] px.
AovImages CastAovImages(const Scene& scene, const TracedScene& traced, const LightTransport& light,
                        const RayGrid& rays, const Pose& X_WC, const AovOptions& options);

}  // namespace fenestra

#pragma once

#include "renderers/light_transport.h"
#include "renderers/ray_caster.h"
#include "renderers/ray_grid.h"

namespace fenestra {

/// Per-pixel truth; see AovImages. Throws InputError if the offsets' size is not the image's or an
/// offset is outside [-64, 64] px.
AovImages CastAovImages(const LightTransport::Surfaces& surfaces, const RayGrid& rays,
                        const Pose& X_WC, const Lighting& lighting, const AovOptions& options);

}  // namespace fenestra

#pragma once

#include <array>
#include <vector>

#include "renderers/traced_scene.h"

namespace fenestra {

/// Which parts of its surroundings a point on a surface sees, each weighted with the cosine to the
/// normal, so that a uniform sky of horizontal illuminance E_h and a ground of reflectance ρ_g give
///
///     E = E_h sky + ρ_g E_h ground.
///
/// Unobstructed: sky = (1 + n_y)/2, ground = (1 − n_y)/2.
struct SkyView {
  float sky = 0.0f;
  float ground = 0.0f;
};

/// The views of one side of a triangle, at its corners.
using TriangleSkyView = std::array<SkyView, 3>;

/// For opaque triangle t: [2 t] is the side that the normal points to, [2 t + 1] the other one.
///
/// Per corner, the visible part of the hemisphere is found with rays, separately above and below
/// the horizon, and multiplies the unobstructed value; panes count with their transmittance. A side
/// that the whole scene lies behind is exact; the inside of a closed body is 0.
///
/// The hemisphere is divided into 32 x 32 cells of equal cosine-weighted solid angle, with a ray
/// each; where neighbouring rays end differently, 16 rays per cell follow. Error: about 0.001.
std::vector<TriangleSkyView> BakeSkyViews(const TracedScene& scene);

}  // namespace fenestra

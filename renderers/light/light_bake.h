#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderers/light/hemisphere_view.h"
#include "renderers/light/light_elements.h"
#include "renderers/light/light_grid.h"
#include "renderers/light/light_patches.h"
#include "renderers/tracing/traced_scene.h"

namespace fenestra {

/// The views of the sky, of the ground and of each other from points of all faces (see
/// LightPatches). Diffuse light depends on the geometry through them alone. A point's irradiance is
///
///     E = Σ_k sky_k L_k + ground M_ground + Σ_e w_e M_e
///
/// with the luminance L_k of each sky patch (its coefficients are known as daylight coefficients:
/// P. R. Tregenza and I. M. Waters, 1983) and the exitances M = π L of the ground and of the
/// elements e; w_e and `ground` are form factors. Unobstructed, Σ_k sky_k = π (1 + n_y)/2 and
/// ground = (1 − n_y)/2 exactly; in a closed room Σ_e w_e = 1.
///
/// A point's hemisphere is divided into 24 x 24 cells of equal cosine-weighted solid angle with a
/// ray each. Where neighbouring rays end differently, in the open or on a surface, 16 or 64 rays
/// per cell follow. The error of the visible part is about 0.001, and 0.003 behind a pane that
/// reaches to grazing angles. Panes count with their transmittance; their mirror images are left
/// out.
///
/// Between points, light is interpolated linearly over the leaves of a grid (see LightGrid). A leaf
/// is halved where something is near, so that light may be curved, and the light at the middle of
/// its hypotenuse is off the mean of its ends by more than 3 %, under a uniform sky with a ground
/// and surfaces that it lights. On leaves of less than 25 cm, more is tolerated in proportion, and
/// none is shorter than 2 cm. The idea is that of the irradiance cache (G. J. Ward, F. M.
/// Rubinstein and R. D. Clear, "A ray tracing solution for diffuse interreflection", 1988).
///
/// A corner of a leaf that no viewer can see, since it lies inside another body or under something
/// that lies on its surface (see HemisphereCaster::About), has the light of the nearest place in
/// the leaf that can be seen: its own would be interpolated over what is visible.
struct LightBake {
  LightPatches patches;
  LightElements elements;
  LightLeaves leaves;

  /// Row of `open_views` of each point. Points of a face before which nothing stands share one.
  std::vector<uint32_t> open_view_of;
  std::vector<OpenView> open_views;
  /// The form factors of point p are [first_factor[p], first_factor[p + 1]).
  std::vector<size_t> first_factor;
  std::vector<FormFactor> factors;

  /// The mean irradiance of element e is Σ w E_point over [first_mean[e], first_mean[e + 1]).
  std::vector<size_t> first_mean;
  std::vector<PointWeight> means;

  size_t point_count() const { return open_view_of.size(); }
};

/// Computes the views. `surfaces` are those of NumberSurfaces. A point takes about 0.2 ms in a
/// scene that is seen to be in pieces. No more leaves are halved once there are `most_points`;
/// where even the first grids have more corners, neighbours that face alike share one.
LightBake BakeLight(const TracedScene& scene, const std::vector<uint32_t>& surfaces,
                    size_t most_points = SIZE_MAX);

}  // namespace fenestra

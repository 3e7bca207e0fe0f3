#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderers/light/hemisphere_view.h"
#include "renderers/tracing/traced_scene.h"

namespace fenestra {

/// The views of the sky, of the ground and of each other from the corners of all surfaces. Diffuse
/// light depends on the geometry through them alone. A point's irradiance is
///
///     E = Σ_k sky_k L_k + ground M_ground + Σ_s w_s M_s
///
/// with the luminance L_k of each sky patch (its coefficients are known as daylight coefficients:
/// P. R. Tregenza and I. M. Waters, 1983) and the exitances M = π L of the ground and of the sides
/// s of triangles; w_s and `ground` are form factors. Unobstructed, Σ_k sky_k = π (1 + n_y)/2 and
/// ground = (1 − n_y)/2 exactly; in a closed room Σ_s w_s = 1.
///
/// A point's hemisphere is divided into 24 x 24 cells of equal cosine-weighted solid angle with a
/// ray each. Where neighbouring rays end differently, in the open or on a surface, 16 rays per cell
/// follow. The error of the visible part is about 0.001, and 0.003 behind a pane that reaches to
/// grazing angles. Panes count with their transmittance; their mirror images are left out.
///
/// A corner that no viewer can see, since it lies inside another body or under something that lies
/// on its surface (see HemisphereCaster::About), has the light of the nearest point of its
/// triangles that can be seen: its own would be interpolated over what is visible of them.
struct LightBake {
  static constexpr uint32_t kNoPoint = ~0u;

  /// The points at the three corners of each side (see SideIndex); kNoPoint inside closed bodies.
  std::vector<std::array<uint32_t, 3>> corners;
  /// Row of `open_views` of each point. The points of a side share one if the whole scene lies
  /// behind it.
  std::vector<uint32_t> open_view_of;
  std::vector<OpenView> open_views;
  /// The form factors of point p are [first_factor[p], first_factor[p + 1]).
  std::vector<size_t> first_factor;
  std::vector<FormFactor> factors;

  size_t point_count() const { return open_view_of.size(); }
};

/// Computes the views. `surfaces` are those of NumberSurfaces: triangles of one surface share the
/// points of a corner. A point takes about 0.3 ms in a scene that is seen to be in pieces. Where
/// there would be more than `most_points`, neighbours that face alike share one (see Thinned).
LightBake BakeLight(const TracedScene& scene, const std::vector<uint32_t>& surfaces,
                    size_t most_points = SIZE_MAX);

}  // namespace fenestra

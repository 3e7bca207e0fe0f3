#pragma once

#include "scenes/facade/facade_plan.h"
#include "scenes/mesh/solid_lattice.h"

namespace fenestra {

/// The solids of which a facade's building consists.
inline constexpr Solid kWallSolid = 1;
inline constexpr Solid kFrameSolid = 2;  ///< The target's frame and its mullions.
inline constexpr Solid kRoomSolid = 3;   ///< The surfaces of the target's room.
inline constexpr Solid kSillSolid = 4;
inline constexpr Solid kLintelSolid = 5;
inline constexpr Solid kOtherFrameSolid = 6;
inline constexpr Solid kOtherRoomSolid = 7;

/// The surfaces of wall, frames, mullions, sills, lintels and rooms. They have no cracks and are
/// closed except for the wall's outer edge. They are finely divided where the light varies: near
/// openings and behind what stands before the wall. The options must be valid, and the plan must
/// have been made from them.
SolidSurface BuildMasonry(const FacadeOptions& options, const FacadePlan& plan);

}  // namespace fenestra

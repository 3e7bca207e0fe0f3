#pragma once

#include "scenes/facade/facade_plan.h"
#include "scenes/mesh/solid_lattice.h"

namespace fenestra {

/// What a facade's building is made of.
inline constexpr Solid kWallSolid = 1;
inline constexpr Solid kFrameSolid = 2;  ///< The target's frame and its mullions.
inline constexpr Solid kRoomSolid = 3;   ///< The surfaces of the target's room.
inline constexpr Solid kSillSolid = 4;
inline constexpr Solid kLintelSolid = 5;
inline constexpr Solid kOtherFrameSolid = 6;
inline constexpr Solid kOtherRoomSolid = 7;

/// The surfaces of wall, frames, mullions, sills, lintels and rooms: without cracks, closed but for
/// the wall's outer edge, and fine where openings and what stands before the wall make the light
/// vary. The options must be valid and the plan theirs.
SolidSurface BuildMasonry(const FacadeOptions& options, const FacadePlan& plan);

}  // namespace fenestra

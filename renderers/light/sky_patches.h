#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scenes/sky_dome.h"

namespace fenestra {

/// The sky in patches of about equal solid angle: seven bands of 12 degrees and a cap at the
/// zenith. Source: P. R. Tregenza, "Subdivision of the sky hemisphere for luminance measurements",
/// 1987.
inline constexpr int kSkyPatches = 145;

/// The patch of a unit direction with y ≥ 0.
int SkyPatchOf(const glm::vec3& direction_W);

/// The mean of L/E_h [1/sr] over each patch.
std::array<double, kSkyPatches> PatchLuminances(const SkyDome& dome);

}  // namespace fenestra

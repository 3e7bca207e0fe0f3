#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace fenestra {

/// A matt surface as a study describes it: how bright it is to the eye and at 830 nm, and its hue.
struct Paint {
  double reflectance = 0.5;        ///< Rec. 709 luminance of the reflectance.
  double reflectance_830nm = 0.5;  ///< At the structured-light projector's wavelength.
  std::string hue = "neutral";     ///< One of Hues().
};

/// The hues that a paint may have.
const std::vector<std::string>& Hues();

/// Linear red, green and blue of a hue, scaled to a luminance of 1. The hue must be one of Hues().
glm::dvec3 HueRgb(const std::string& hue);

/// The highest reflectance that a hue can have: above it, one of its colours would reflect more
/// light than it receives.
double MostReflectance(const std::string& hue);

/// Its reflectance has the paint's luminance and hue.
Material MaterialOf(const std::string& name, const Paint& paint);

}  // namespace fenestra

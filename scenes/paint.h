#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/io/faults.h"
#include "scenes/scene.h"

namespace fenestra {

/// Hues of paints, of which HueRgb has the colours.
enum class Hue { kNeutral, kBrickRed, kOchre, kBrown, kGreen, kBlue };

/// The names of the hues, in order: neutral, brick_red, ...
const std::vector<std::string>& HueNames();

/// A matt surface as a study describes it: how bright it is to the eye and at 830 nm, and its hue.
struct Paint {
  double reflectance = 0.5;        ///< Rec. 709 luminance of the reflectance.
  double reflectance_830nm = 0.5;  ///< At the structured-light projector's wavelength.
  Hue hue = Hue::kNeutral;         ///< Hue of the visible reflectance.
};

/// Linear red, green and blue of a hue, scaled to a luminance of 1.
glm::dvec3 HueRgb(Hue hue);

/// The highest reflectance that a hue can have. Above it, one of its three colours would have to
/// reflect more light than it receives; 1 for grey.
double MostReflectance(Hue hue);

/// Adds a fault for reflectances beyond [0, 1] or beyond what the hue can have. `name` and
/// "_reflectance" make the name of the paint's reflectance.
void CheckPaint(const std::string& name, const Paint& paint, Faults& faults);

/// A material whose reflectance has the paint's luminance and hue.
Material MaterialOf(const std::string& name, const Paint& paint);

}  // namespace fenestra

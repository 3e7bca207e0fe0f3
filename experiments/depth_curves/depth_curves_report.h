#pragma once

#include <string>

#include "experiments/depth_curves/depth_curves.h"

namespace fenestra {

/// Tables of both models' curves side by side, with what is published and what is predicted
/// (depth_laws.h), and above them the largest differences between the models. Both must have been
/// measured at the same distances, angles and illuminances.
std::string DepthCurvesMarkdown(const StructuredLightOptions& options,
                                const DepthCurves& parametric, const DepthCurves& speckle);

}  // namespace fenestra

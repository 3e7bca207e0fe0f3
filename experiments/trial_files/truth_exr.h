#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderers/exr_io.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// Per-pixel truth as named channels of an OpenEXR file:
///
///     Y, or R G B, or infrared.Y    radiance: see Band
///     depth.Z                       along the optical axis [m]; NaN: nothing hit
///     normal.X, normal.Y, normal.Z  geometric, in the camera frame
///     object.ID, material.ID        indices into the scene; -1: nothing hit
///     irradiance.lx, irradiance.830nm
///     reflectance.830nm, transmittance.T
///     sun.V, <point>.V              1 where the sun or the point sees the surface
///     disparity.U, disparity.V      [px]
///
/// with the channels' meaning, the camera's intrinsics and its pose as metadata.
std::vector<ExrChannel> AovChannels(const AovImages& aovs, const std::string& point);

/// CV_32FC1 in one band, or B, G, R.
std::vector<ExrChannel> RadianceChannels(const cv::Mat& radiance, Band band);

std::map<std::string, std::string> CameraMetadata(const CameraModel& camera, const Pose& X_WC);

/// All of it; `point` names what TruthImages::aovs' sees_point is: "right" or "projector".
void WriteTruthExr(const std::filesystem::path& file, const TruthImages& truth,
                   const std::string& point);

}  // namespace fenestra

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/io/output_path.h"
#include "experiments/trial/trial_runner.h"

namespace fenestra {

/// Writes pictures for people: the observation's images and every stage picture of a detector,
/// truth (green, where it is known) and estimate (magenta) drawn over each, and its clouds (PCD).
///
///     left.png, right.png                          (stereo)
///     color.png, depth.png (false colours)         (RGB-D)
///     1_<picture>.png, ..., <cloud>.pcd
void WritePictures(const OutputPath& folder, const Observation& observation,
                   const SensorCalibration& calibration, const GroundTruth* truth,
                   const WindowEstimate* estimate, const StageLog& log);

/// Writes a trial's pictures under every detector, each in a folder of its name.
void WritePictures(const OutputPath& folder, const FinishedTrial& trial);

/// Writes one observation as a detector gets it, the files that `fenestra detect` reads:
///
///     left.png, right.png, calibration.yaml                          (stereo)
///     color.png, depth.png (16 bit), calibration.yaml, cloud.pcd     (RGB-D)
///
/// and into the folder `truth` what no detector may see:
///
///     truth.json        poses and the window's centroid, corners and normal in the scored camera
///     calibration.yaml  the true cameras
///     truth.exr         per pixel: radiance, depth, normal, ids, light, visibility, disparity
///     cloud.pcd         the true surface in the scored camera's frame
///     no_return.png     why depth pixels have no return (RGB-D)
///     infrared.png      what the infra-red camera sees (RGB-D by matching)
///     trial.yaml        every factor's value in this trial
void WriteTrialFiles(const OutputPath& folder, const TrialRunner& runner,
                     const SimulatedTrial& simulated);

/// Write the first and the second half of these files, each into a folder of its own.
void WriteObservationFiles(const OutputPath& folder, const SimulatedTrial& simulated);
void WriteTruthFiles(const OutputPath& folder, const TrialRunner& runner,
                     const SimulatedTrial& simulated);

}  // namespace fenestra

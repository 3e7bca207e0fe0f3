#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/detection/observation.h"
#include "core/io/yaml_reader.h"
#include "experiments/study/factors.h"
#include "experiments/study_file/detector_reader.h"
#include "sim/truth/ground_truth.h"

namespace fenestra {

/// One observation of a recorded sequence and what was surveyed of it.
struct SequenceFrame {
  int cell = 0;   ///< Frames with the same part and levels are one cell, in order of appearance.
  int trial = 0;  ///< Index in the cell, from 0.
  std::string part;
  FactorValues levels;
  FactorValues drawn;
  ObservationFiles files;
  GroundTruth truth;  ///< X_WC is not known and stays the identity.
};

/// A recorded sequence with its surveyed truth.
struct Sequence {
  std::string name;
  std::string description;
  SensorKind sensor = SensorKind::kStereo;
  std::vector<DetectorChoice> detectors;  ///< Every one of the sensor, unless the file names some.
  std::vector<SequenceFrame> frames;
  std::string text;  ///< As written by the user.
};

/// Reads a sequence. Paths are relative to the file. Throws InputError with all faults of the file
/// and their positions; a missing image is one of them.
///
///   name: corridor                 # [a-z0-9_-]+
///   description: What was filmed.  # optional
///   sensor: stereo                 # or rgbd
///   detectors: [edge-stereo]       # optional, as in a study
///   calibration: stereo.yaml       # of all frames; a frame may have its own
///   frames:
///     - {left: l0.png, right: r0.png,                      # rgbd: color, depth
///        truth: {centroid_m: [0.1, -0.2, 2.4], width_m: 0.9, height_m: 1.2}}
///     - {left: l1.png, right: r1.png, truth: none}         # there is no window
///
/// A truth's centroid is that of the frame's front outer rectangle, in the true, unrectified left
/// camera (stereo) or in the camera whose pixels the depth image has: x to the right, y down, z
/// along the optical axis. It may further say `in_view: false` (the frame is then counted apart)
/// and `other_windows: [{centroid_m: …, width_m: …, height_m: …}]`. A frame may further say of
/// which `part` it is and give `levels` and `drawn`, mappings of names to values: frames are
/// summarised by part and levels.
Sequence ReadSequence(const std::filesystem::path& file);

/// Reads the truth that was surveyed of one observation; faults are noted in the reader.
GroundTruth ReadSurveyedTruth(YamlReader& reader, const YAML::Node& node);

/// The truth as YAML, on one line; ReadSurveyedTruth reads it back.
std::string ToYaml(const GroundTruth& truth);

}  // namespace fenestra

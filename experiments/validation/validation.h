#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/validation/row.h"
#include "experiments/validation/simulated_planes.h"
#include "sim/camera/image_sensor.h"

namespace fenestra::validation {

struct ValidationOptions {
  /// The folder of recordings, laid out as tests/data.
  std::filesystem::path recordings = "tests/data";
  /// What comparisons with other programs said last: tests/peers/results.md.
  std::filesystem::path peers = "tests/peers/results.md";
};

/// All rows, of the sensors as they are by default. Throws InputError for recordings that cannot be
/// read.
std::vector<Row> AllRows(const ValidationOptions& options);

/// A Markdown document with the section "Verdicts".
std::string ValidationMarkdown(const std::vector<Row>& rows);

// The parts of AllRows.

/// The structured-light sensor beside recorded planes: the step of depth, noise and its
/// correlation, the share of pixels with a return, smooth errors.
std::vector<Row> DepthRows(const std::filesystem::path& recordings,
                           const StructuredLightOptions& options = SensorOfRecordings());

/// The projector's shadow behind a recorded person's head, beside that of a plate as wide, as near
/// and as far from a wall. The image is registered: the shadow lies on both sides.
std::vector<Row> ShadowRows(const std::filesystem::path& recordings,
                            const StructuredLightOptions& options = SensorOfRecordings());

/// What the structured-light sensor does where no recording that may be handed on judges it: black
/// paint, noise in time, borders, empty columns, daylight. Some figures of recordings are known
/// without their files; against these rows are judged.
std::vector<Row> UnrecordedDepthRows(const StructuredLightOptions& options = SensorOfRecordings());

/// A calibration from the recorded pairs of a board (stereo-calibration), beside one from as many
/// simulated pairs of the stereo rig. The tolerances of boards were chosen by this recording.
std::vector<Row> CalibrationRows(const std::filesystem::path& recordings);

/// The sensor's grey values and their variance beside figures of recorded 8-bit images.
std::vector<Row> PhotonTransferRows(const ImageSensorOptions& sensor);

/// The sensor's own figures beside what an EMVA 1288 evaluation of its images finds.
std::vector<Row> EmvaRows(const ImageSensorOptions& sensor);

/// What the comparison of the renderer with Cycles said last, in the results that tests/peers
/// writes; a row without a result if that file is not there or does not name Cycles.
Row CyclesRow(const std::filesystem::path& results);

}  // namespace fenestra::validation

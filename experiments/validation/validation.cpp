#include "experiments/validation/validation.h"

#include <iterator>

#include "sim/stereo/stereo_rig.h"

namespace fenestra::validation {

std::vector<Row> AllRows(const ValidationOptions& options) {
  const ImageSensorOptions sensor = StereoRigOptions().sensor;
  std::vector<Row> rows = DepthRows(options.recordings);
  for (std::vector<Row> more : {ShadowRows(options.recordings, SensorOfRecordings()),
                                UnrecordedDepthRows(SensorOfRecordings()),
                                CalibrationRows(options.recordings),
                                PhotonTransferRows(sensor),
                                EmvaRows(sensor),
                                {CyclesRow(options.peers)}}) {
    std::move(more.begin(), more.end(), std::back_inserter(rows));
  }
  return rows;
}

std::string ValidationMarkdown(const std::vector<Row>& rows) {
  return "# Validation\n\n## Verdicts\n\n" + ToMarkdown(rows);
}

}  // namespace fenestra::validation

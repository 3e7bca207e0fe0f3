#pragma once

#include <opencv2/core.hpp>

#include "experiments/emva/evaluation.h"

namespace fenestra::emva {

/// Photon transfer, responsivity, signal to noise and linearity, with the fits and their ranges.
cv::Mat3b PhotonTransferPicture(const Results& results);

}  // namespace fenestra::emva

// replaced by the detector

#pragma once

#include <optional>

#include "core/io/output_path.h"
#include "core/random/random_stream.h"
#include "experiments/emva/evaluation.h"
#include "sim/camera/image_sensor.h"

namespace fenestra::emva {

/// How the series of a simulated sensor is taken.
struct SimulationOptions {
  cv::Size size{752, 480};
  int exposures = 50;  ///< Release 4.0 asks for at least 50.
  int frames = 100;    ///< Images in each stack for the spatial figures.
  double gain = 1.0;
  double wavelength_nm = 530.0;
  double quantum_efficiency = 0.524;  ///< At that wavelength.
  double longest_exposure_s = 20e-3;  ///< At 108 % of saturation.
};

/// Throws InputError with all faults.
void Validate(const SimulationOptions& options);

/// The exposures, equally spread up to a little beyond saturation under constant light, and the
/// names of their files.
Series PlanSeries(const SimulationOptions& options, const ImageSensorOptions& sensor);

/// Takes the images with a simulated sensor: Poisson photons whose mean is the same in all pixels.
/// Each image's noise belongs to its set and number.
ImageReader Simulate(const SimulationOptions& options, const ImageSensorOptions& sensor,
                     const RandomStream& camera);

/// The sensor's own figures, which the evaluation should find.
struct PutIn {
  double gain_dn_per_e;
  double quantum_efficiency;
  double dark_noise_e;
  double dark_current_e_s;
  /// Where the temporal variance, averaged over the pixels, is largest: the standard's definition.
  /// It lies below full scale, since pixels of more sensitivity, and noise, are clipped before.
  /// nullopt with a shoulder, on which the variance is flat: noise then says where it is largest.
  std::optional<double> saturation_e;
  double dsnu_e;
  double prnu;
};
PutIn PutInBy(const SimulationOptions& options, const ImageSensorOptions& sensor);

/// Writes all images (PNG, of 8 bits or 16) and, at last, the descriptor emva1288.txt into the
/// folder. Returns the descriptor's path.
std::filesystem::path WriteSeries(const OutputPath& folder, const Series& series,
                                  const ImageReader& images);

}  // namespace fenestra::emva

#pragma once

namespace fenestra {

/// Quantum efficiency of the MT9V032 family, monochrome: electrons per photon. Linear between
/// samples 10 nm apart; 0 outside 380–1000 nm.
/// Source: onsemi MT9V034/D Rev. 7, Fig. 47, digitised to ±0.005.
double QuantumEfficiency(double wavelength_nm);

/// The spectrum of the light on the scene.
enum class Illuminant {
  kDaylight,      ///< ASTM G173-03, global: sun and sky at air mass 1.5.
  kIncandescent,  ///< A black body at 2856 K (CIE illuminant A).
};

/// Response of a camera's pixel to light of several wavelengths.
struct SpectralOptions {
  Illuminant illuminant = Illuminant::kDaylight;
  /// Longest wavelength that the lens' filter lets pass. 650 nm is the usual infra-red cut filter;
  /// from 1000 nm on there is no filter.
  double cut_off_nm = 650.0;
  /// The pixel's quantum efficiency as a multiple of QuantumEfficiency().
  double quantum_efficiency_scale = 1.0;
};

/// Photo-electrons per pixel and lux-second of the illuminant's light, measured before the filter:
///
///     R = A ∫ E(λ) η(λ) F(λ) λ/(h c) dλ / (683 lm/W ∫ E(λ) V(λ) dλ)
///
/// A: the pixel's area [m²]; V: CIE 1924. Sums over 10 nm from 380 to 1000 nm.
double ElectronsPerLuxSecond(const SpectralOptions& options, double pixel_pitch_m);

}  // namespace fenestra

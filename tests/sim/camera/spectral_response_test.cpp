#include "sim/camera/spectral_response.h"

#include <gtest/gtest.h>

namespace fenestra {
namespace {

constexpr double kPitch_m = 6e-6;

TEST(SpectralResponseTest, QuantumEfficiencyIsTheDataSheets) {
  EXPECT_DOUBLE_EQ(QuantumEfficiency(550.0), 0.524);
  EXPECT_DOUBLE_EQ(QuantumEfficiency(830.0), 0.387);
  EXPECT_DOUBLE_EQ(QuantumEfficiency(555.0), 0.5 * (0.524 + 0.541));
  EXPECT_DOUBLE_EQ(QuantumEfficiency(1000.0), 0.068);
  EXPECT_EQ(QuantumEfficiency(379.0), 0.0);
  EXPECT_EQ(QuantumEfficiency(1001.0), 0.0);
}

TEST(SpectralResponseTest, DaylightGivesTheElectronsOfTheStandardSpectrum) {
  // The same integrals over the 1 nm table of ASTM G173-03: 3.4e5 without a filter and 1.7e5 with a
  // 650 nm one, both to two digits.
  const SpectralOptions filtered{.cut_off_nm = 650.0};
  const SpectralOptions open{.cut_off_nm = 1100.0};
  EXPECT_NEAR(ElectronsPerLuxSecond(filtered, kPitch_m), 1.7e5, 0.05e5);
  EXPECT_NEAR(ElectronsPerLuxSecond(open, kPitch_m), 3.4e5, 0.05e5);
}

TEST(SpectralResponseTest, IncandescentLightIsRicherInInfraRed) {
  const auto ratio = [](Illuminant illuminant) {
    return ElectronsPerLuxSecond({.illuminant = illuminant, .cut_off_nm = 1100.0}, kPitch_m) /
           ElectronsPerLuxSecond({.illuminant = illuminant, .cut_off_nm = 650.0}, kPitch_m);
  };
  EXPECT_NEAR(ratio(Illuminant::kDaylight), 2.0, 0.1);
  // A black body at 2856 K sends more than twice as much between 650 and 1000 nm as below.
  EXPECT_GT(ratio(Illuminant::kIncandescent), 3.5);
}

TEST(SpectralResponseTest, ElectronsGrowWithAreaAndEfficiency) {
  const double one = ElectronsPerLuxSecond({}, kPitch_m);
  EXPECT_NEAR(ElectronsPerLuxSecond({}, 2.0 * kPitch_m), 4.0 * one, 1e-6 * one);
  EXPECT_NEAR(ElectronsPerLuxSecond({.quantum_efficiency_scale = 0.5}, kPitch_m), 0.5 * one,
              1e-6 * one);
}

}  // namespace
}  // namespace fenestra

#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <tuple>
#include <vector>

#include "experiments/trial/trial_record.h"

namespace fenestra::testing {

inline std::vector<uint64_t> Bits(const auto& matrix) {
  std::vector<uint64_t> bits;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    bits.push_back(std::bit_cast<uint64_t>(matrix.data()[i]));
  }
  return bits;
}

inline void ExpectSameBits(const FactorValues& a, const FactorValues& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].first, b[i].first);
    ASSERT_EQ(a[i].second.index(), b[i].second.index());
    if (const double* number = std::get_if<double>(&a[i].second)) {
      EXPECT_EQ(std::bit_cast<uint64_t>(*number),
                std::bit_cast<uint64_t>(std::get<double>(b[i].second)));
    } else {
      EXPECT_EQ(a[i].second, b[i].second);
    }
  }
}

inline void ExpectSameBits(const Score& a, const Score& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.detail, b.detail);
  ASSERT_EQ(a.truth_p_CO.has_value(), b.truth_p_CO.has_value());
  if (a.truth_p_CO) {
    EXPECT_EQ(Bits(*a.truth_p_CO), Bits(*b.truth_p_CO));
  }
  ASSERT_EQ(a.estimate.has_value(), b.estimate.has_value());
  if (!a.estimate) return;
  EXPECT_EQ(Bits(a.estimate->p_CO), Bits(b.estimate->p_CO));
  EXPECT_EQ(Bits(a.estimate->normal_C), Bits(b.estimate->normal_C));
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(Bits(a.estimate->p_CV[i]), Bits(b.estimate->p_CV[i]));
  ASSERT_EQ(a.estimate->covariance_C.has_value(), b.estimate->covariance_C.has_value());
  if (a.estimate->covariance_C) {
    EXPECT_EQ(Bits(*a.estimate->covariance_C), Bits(*b.estimate->covariance_C));
  }
}

inline void ExpectSameBits(const TrialRecord& a, const TrialRecord& b) {
  EXPECT_EQ(std::tie(a.cell, a.trial, a.part, a.sensor, a.detector),
            std::tie(b.cell, b.trial, b.part, b.sensor, b.detector));
  ExpectSameBits(a.levels, b.levels);
  ExpectSameBits(a.drawn, b.drawn);
  ExpectSameBits(a.score, b.score);
  ASSERT_EQ(a.bound_C.has_value(), b.bound_C.has_value());
  if (a.bound_C) {
    EXPECT_EQ(Bits(*a.bound_C), Bits(*b.bound_C));
  }
  ASSERT_EQ(a.stages.size(), b.stages.size());
  for (size_t i = 0; i < a.stages.size(); ++i) {
    EXPECT_EQ(a.stages[i].stage, b.stages[i].stage);
    EXPECT_EQ(std::bit_cast<uint64_t>(a.stages[i].seconds),
              std::bit_cast<uint64_t>(b.stages[i].seconds));
  }
}

}  // namespace fenestra::testing

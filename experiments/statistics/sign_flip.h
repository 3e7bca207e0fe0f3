#pragma once

#include <span>

namespace fenestra {

/// P-value against "the differences lie symmetrically around 0, cluster by cluster" for "they tend
/// to be above 0": the share of assignments of random signs to d_1 ... d_r whose sum is at least
/// Σ d_i. With differences of ±1 that is McNemar's test of discordant pairs, with ranks Wilcoxon's
/// signed-rank test.
///
/// All 2^r assignments for up to 16 differences that are not 0; else 19,999 random ones, drawn from
/// a fixed stream and counted together with the one observed, so that the test keeps its level
/// whatever r is (B. Phipson, G. Smyth, "Permutation p-values should never be zero", 2010). Above
/// 2000 differences, the normal limit of Σ d_i / √Σ d_i².
///
/// 1 without differences.
double SignFlipPValue(std::span<const double> differences);

}  // namespace fenestra

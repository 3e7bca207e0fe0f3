#pragma once

#include <vector>

namespace fenestra {

/// The numbers of trials at which a sequential procedure looks at its data: `first`, then each half
/// as many again, and at last `most`. Fixed beforehand, so that what was seen cannot move them.
/// Domain: 1 ≤ first, 1 ≤ most.
std::vector<int> Looks(int first, int most);

/// The confidence of each look's interval with which all intervals of `looks` looks cover together
/// with at least `confidence`, whatever rule says when to stop:
///
///     1 - (1 - confidence) / looks
///
/// (Bonferroni; the error is spent in equal parts.) So the interval at which a study stopped covers
/// with that confidence, too. Exact intervals stay exact in this sense.
double LookConfidence(double confidence, int looks);

}  // namespace fenestra

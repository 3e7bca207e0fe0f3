#pragma once

#include <optional>
#include <span>
#include <string>

#include "experiments/analysis/envelope_search.h"
#include "experiments/output/plot.h"

namespace fenestra {

/// One line for each range where the requirement holds; one without a range where it holds nowhere.
std::string EnvelopeCsv(const Study& study, std::span<const EnvelopeCurve> envelopes);

/// A table for each part, with the requirement and how to read it; empty without envelopes.
std::string EnvelopeMarkdown(const Study& study, std::span<const EnvelopeCurve> envelopes);

/// The far boundary, and the near one where it is not the first level, of each detector over the
/// first other factor with several numbers as levels: a diagram for each part and combination of
/// the remaining levels. nullopt if there is no such factor.
std::optional<cv::Mat3b> EnvelopePicture(const Study& study,
                                         std::span<const EnvelopeCurve> envelopes);

}  // namespace fenestra

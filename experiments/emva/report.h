#pragma once

#include <optional>
#include <string>

#include "experiments/emva/simulated_series.h"

namespace fenestra::emva {

/// The figures as a table: measured and, where the camera is ours, put in, with the difference.
std::string ReportText(const Results& results, const std::optional<PutIn>& put_in);
std::string ReportMarkdown(const Results& results, const std::optional<PutIn>& put_in);
std::string ReportJson(const Results& results, const std::optional<PutIn>& put_in);

}  // namespace fenestra::emva

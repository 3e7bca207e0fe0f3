#include "experiments/study/metric.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/system/check.h"

namespace fenestra {
namespace {

using Kind = Metric::Kind;

struct QuantityNames {
  Quantity quantity;
  const char* name;
  const char* unit;
};

constexpr QuantityNames kQuantities[] = {
    {Quantity::kError, "centroid_error_mm", "mm"},
    {Quantity::kErrorX, "centroid_error_x_mm", "mm"},
    {Quantity::kErrorY, "centroid_error_y_mm", "mm"},
    {Quantity::kErrorZ, "centroid_error_z_mm", "mm"},
    {Quantity::kErrorAcross, "centroid_error_across_mm", "mm"},
    {Quantity::kTime, "time_ms", "ms"},
    {Quantity::kErrorOverBound, "error_over_bound", ""},
    {Quantity::kNormalisedSquare, "normalised_square", ""},
};

const QuantityNames& NamesOf(Quantity quantity) {
  for (const QuantityNames& names : kQuantities) {
    if (names.quantity == quantity) return names;
  }
  FENESTRA_CHECK(false, "quantity out of range");
}

Metric Rate(Outcome outcome) {
  return {.kind = Kind::kRate, .outcome = outcome};
}

Metric Of(Kind kind, Quantity quantity) {
  return {.kind = kind, .quantity = quantity};
}

Metric Within(Quantity quantity, double limit) {
  return {.kind = Kind::kWithin, .quantity = quantity, .limit = limit};
}

Metric QuantileOf(Quantity quantity, double level) {
  return {.kind = Kind::kQuantile, .level = level, .quantity = quantity};
}

std::vector<NamedMetric> MakeMetrics() {
  std::vector<NamedMetric> all;
  for (const Outcome outcome :
       {Outcome::kHit, Outcome::kGross, Outcome::kWrongWindow, Outcome::kMissed, Outcome::kCrashed,
        Outcome::kOutOfView, Outcome::kFalseAlarm, Outcome::kClear}) {
    all.push_back({fmt::format("{}_rate", ToString(outcome)), Rate(outcome)});
  }
  all.push_back({"bias_x_mm", Of(Kind::kBias, Quantity::kErrorX)});
  all.push_back({"bias_y_mm", Of(Kind::kBias, Quantity::kErrorY)});
  all.push_back({"bias_z_mm", Of(Kind::kBias, Quantity::kErrorZ)});
  all.push_back({"rmse_mm", Of(Kind::kRmse, Quantity::kError)});
  all.push_back({"rmse_depth_mm", Of(Kind::kRmse, Quantity::kErrorZ)});
  all.push_back({"rmse_across_mm", Of(Kind::kRmse, Quantity::kErrorAcross)});
  all.push_back({"p50_error_mm", QuantileOf(Quantity::kError, 0.50)});
  all.push_back({"p95_error_mm", QuantileOf(Quantity::kError, 0.95)});
  for (const int percent : {5, 10}) {
    all.push_back(
        {fmt::format("hit_rate_{}pct", percent), Within(Quantity::kError, 0.01 * percent)});
  }
  for (const auto& [name, quantity] :
       {std::pair("depth", Quantity::kErrorZ), std::pair("across", Quantity::kErrorAcross)}) {
    for (const int percent : {5, 10, 25}) {
      all.push_back(
          {fmt::format("{}_rate_{}pct", name, percent), Within(quantity, 0.01 * percent)});
    }
  }
  for (const auto& [name, quantity] :
       {std::pair("depth", Quantity::kErrorZ), std::pair("across", Quantity::kErrorAcross)}) {
    all.push_back({fmt::format("p50_{}_mm", name), QuantileOf(quantity, 0.50)});
    all.push_back({fmt::format("p95_{}_mm", name), QuantileOf(quantity, 0.95)});
  }
  all.push_back({"trimmed_rmse_mm", Of(Kind::kTrimmedRmse, Quantity::kError)});
  all.push_back({"trimmed_rmse_depth_mm", Of(Kind::kTrimmedRmse, Quantity::kErrorZ)});
  all.push_back({"trimmed_rmse_across_mm", Of(Kind::kTrimmedRmse, Quantity::kErrorAcross)});
  all.push_back({"rmse_over_bound", Of(Kind::kOverBound, Quantity::kError)});
  all.push_back({"rmse_depth_over_bound", Of(Kind::kOverBound, Quantity::kErrorZ)});
  all.push_back({"rms_error_over_bound", Of(Kind::kRmse, Quantity::kErrorOverBound)});
  all.push_back(
      {"trimmed_rms_error_over_bound", Of(Kind::kTrimmedRmse, Quantity::kErrorOverBound)});
  all.push_back({"p50_error_over_bound", QuantileOf(Quantity::kErrorOverBound, 0.50)});
  all.push_back({"within_6_bounds_rate", Within(Quantity::kErrorOverBound, kFarBounds)});
  all.push_back({"within_covariance_rate", Within(Quantity::kNormalisedSquare, kChiSquare3At95)});
  all.push_back({"p50_normalised_square", QuantileOf(Quantity::kNormalisedSquare, 0.50)});
  all.push_back({"mean_normalised_square", Of(Kind::kBias, Quantity::kNormalisedSquare)});
  all.push_back({"p50_time_ms", QuantileOf(Quantity::kTime, 0.50)});
  return all;
}

std::vector<std::string> NamesWhere(bool (*wanted)(const Metric&)) {
  std::vector<std::string> names;
  for (const NamedMetric& named : Metrics()) {
    if (wanted(named.metric)) names.push_back(named.name);
  }
  return names;
}

constexpr const char* kBiasOfAllAxes = "bias_mm";

}  // namespace

const char* ToString(Quantity quantity) {
  return NamesOf(quantity).name;
}

const std::vector<Quantity>& AllQuantities() {
  static const std::vector<Quantity> all = [] {
    std::vector<Quantity> quantities;
    for (const QuantityNames& names : kQuantities) quantities.push_back(names.quantity);
    return quantities;
  }();
  return all;
}

const char* UnitOf(Quantity quantity) {
  return NamesOf(quantity).unit;
}

CountedRows RowsOf(const Metric& metric) {
  if (metric.kind == Kind::kRate) {
    if (metric.outcome == Outcome::kOutOfView) return CountedRows::kWithTarget;
    const bool empty = metric.outcome == Outcome::kFalseAlarm || metric.outcome == Outcome::kClear;
    return empty ? CountedRows::kWithoutTarget : CountedRows::kAttempts;
  }
  if (metric.quantity == Quantity::kTime) {
    return metric.kind == Kind::kQuantile ? CountedRows::kTimed : CountedRows::kTimedHits;
  }
  if (metric.quantity == Quantity::kErrorOverBound) return CountedRows::kBoundedHits;
  if (metric.quantity == Quantity::kNormalisedSquare) return CountedRows::kHitsWithCovariance;
  const bool of_all = metric.kind == Kind::kWithin || metric.kind == Kind::kQuantile;
  return of_all ? CountedRows::kAttempts : CountedRows::kHits;
}

const char* ToString(CountedRows rows) {
  switch (rows) {
    case CountedRows::kAttempts:
      return "attempts";
    case CountedRows::kWithTarget:
      return "trials with a target";
    case CountedRows::kWithoutTarget:
      return "scenes without a window";
    case CountedRows::kHits:
      return "hits";
    case CountedRows::kBoundedHits:
      return "hits with a bound";
    case CountedRows::kHitsWithCovariance:
      return "hits with a covariance";
    case CountedRows::kTimed:
      return "timed trials";
    case CountedRows::kTimedHits:
      return "timed hits";
  }
  FENESTRA_CHECK(false, "rows out of range");
}

const char* UnitOf(const Metric& metric) {
  const bool is_ratio = metric.IsShare() || metric.kind == Kind::kOverBound;
  return is_ratio ? "" : UnitOf(metric.quantity);
}

const std::vector<NamedMetric>& Metrics() {
  static const std::vector<NamedMetric> all = MakeMetrics();
  return all;
}

std::optional<Metric> FindMetric(std::string_view name) {
  for (const NamedMetric& named : Metrics()) {
    if (named.name == name) return named.metric;
  }
  return std::nullopt;
}

std::string ColumnOf(std::string_view metric, std::string_view suffix) {
  for (const std::string_view unit : {"_mm", "_ms"}) {
    if (!metric.ends_with(unit)) continue;
    return fmt::format("{}{}{}", metric.substr(0, metric.size() - unit.size()), suffix, unit);
  }
  return fmt::format("{}{}", metric, suffix);
}

const std::vector<std::string>& StoppingMetrics() {
  // Times differ from run to run: a rule on them would stop elsewhere each time. What bounds and
  // covariances say does not exist for every detector.
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = NamesWhere([](const Metric& metric) {
      const CountedRows rows = RowsOf(metric);
      return rows != CountedRows::kTimed && rows != CountedRows::kBoundedHits &&
             rows != CountedRows::kHitsWithCovariance && metric.kind != Kind::kOverBound;
    });
    all.push_back(kBiasOfAllAxes);
    return all;
  }();
  return names;
}

std::vector<std::string> MetricsOfTarget(std::string_view name) {
  if (name == kBiasOfAllAxes) return {"bias_x_mm", "bias_y_mm", "bias_z_mm"};
  const auto& known = StoppingMetrics();
  if (std::find(known.begin(), known.end(), name) == known.end()) return {};
  return {std::string(name)};
}

const std::vector<std::string>& RequirementMetrics() {
  static const std::vector<std::string> names = NamesWhere([](const Metric& metric) {
    if (RowsOf(metric) != CountedRows::kAttempts) return false;
    const bool good = metric.kind == Kind::kWithin ||
                      (metric.kind == Kind::kRate && metric.outcome == Outcome::kHit);
    return good || metric.kind == Kind::kQuantile;
  });
  return names;
}

}  // namespace fenestra

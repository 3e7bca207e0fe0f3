#include "experiments/statistics/sobol_indices.h"

#include <algorithm>
#include <cmath>
#include <openturns/MartinezSensitivityAlgorithm.hxx>

#include "core/system/check.h"

namespace fenestra {
namespace {

constexpr int kIndexResamples = 500;

struct Estimates {
  std::vector<double> first;
  std::vector<double> total;
};

bool IsConstant(const Eigen::VectorXd& values) {
  return values.maxCoeff() == values.minCoeff();
}

// OpenTURNS takes the columns one below the other, and asks for inputs of which it uses the number.
std::optional<Estimates> EstimatesOf(const Eigen::MatrixXd& rows) {
  for (Eigen::Index column = 0; column < rows.cols(); ++column) {
    if (IsConstant(rows.col(column))) return std::nullopt;
  }
  const auto size = static_cast<OT::UnsignedInteger>(rows.rows());
  const auto causes = static_cast<OT::UnsignedInteger>(rows.cols() - 2);
  OT::Sample outputs(size * (causes + 2), 1);
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    outputs(static_cast<OT::UnsignedInteger>(i), 0) = rows.data()[i];  // Column by column.
  }
  const OT::Sample inputs(outputs.getSize(), causes);
  const OT::MartinezSensitivityAlgorithm algorithm(inputs, outputs, size);
  const OT::Point first = algorithm.getFirstOrderIndices();
  const OT::Point total = algorithm.getTotalOrderIndices();
  return Estimates{{first.begin(), first.end()}, {total.begin(), total.end()}};
}

Eigen::MatrixXd Resampled(const Eigen::MatrixXd& rows, const RandomStream& stream) {
  std::vector<float> uniforms(static_cast<size_t>(rows.rows()));
  stream.FillUniforms(uniforms);
  Eigen::MatrixXd resampled(rows.rows(), rows.cols());
  const auto count = static_cast<double>(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto place = static_cast<Eigen::Index>(double{uniforms[static_cast<size_t>(i)]} * count);
    resampled.row(i) = rows.row(std::min(rows.rows() - 1, place));
  }
  return resampled;
}

Interval Percentiles(const std::vector<double>& values, double confidence) {
  const double tail = (1.0 - confidence) / 2.0;
  return {.lower = SampleQuantile(values, tail), .upper = SampleQuantile(values, 1.0 - tail)};
}

}  // namespace

std::optional<std::vector<SobolIndex>> SobolIndices(const Eigen::MatrixXd& rows,
                                                    const RandomStream& resampling,
                                                    double confidence) {
  FENESTRA_CHECK(rows.cols() >= 3, "a pick-freeze design has at least one cause");
  FENESTRA_CHECK(0.0 < confidence && confidence < 1.0, "confidence");
  if (rows.rows() < kFewestRows) return std::nullopt;
  const auto whole = EstimatesOf(rows);
  if (!whole) return std::nullopt;
  const size_t causes = whole->first.size();
  std::vector<std::vector<double>> first(causes);
  std::vector<std::vector<double>> total(causes);
  for (uint64_t b = 0; b < kIndexResamples; ++b) {
    const auto estimates = EstimatesOf(Resampled(rows, resampling.Child("resample", b)));
    if (!estimates) continue;
    for (size_t i = 0; i < causes; ++i) {
      first[i].push_back(estimates->first[i]);
      total[i].push_back(estimates->total[i]);
    }
  }
  if (first.front().empty()) return std::nullopt;
  std::vector<SobolIndex> indices;
  for (size_t i = 0; i < causes; ++i) {
    indices.push_back({.first = whole->first[i],
                       .first_interval = Percentiles(first[i], confidence),
                       .total = whole->total[i],
                       .total_interval = Percentiles(total[i], confidence)});
  }
  return indices;
}

}  // namespace fenestra

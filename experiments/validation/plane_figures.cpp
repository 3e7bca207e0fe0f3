#include "experiments/validation/plane_figures.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "core/random/random_stream.h"
#include "experiments/statistics/moments.h"

namespace fenestra::validation {
namespace {

constexpr int kBlock = 32;

// Residuals of 1/z to the plane that fits a block best; none where too few pixels return.
std::optional<cv::Mat1d> BlockResiduals(const DepthView& view, const cv::Rect& block) {
  std::vector<cv::Point> pixels;
  for (int v = block.y; v < block.br().y; ++v) {
    for (int u = block.x; u < block.br().x; ++u) {
      if (view.z_m(v, u) > 0.0) pixels.emplace_back(u, v);
    }
  }
  if (pixels.size() < 0.9 * block.area()) return std::nullopt;
  cv::Mat1d residuals(block.size(), std::nan(""));
  for (int round = 0; round < 2; ++round) {
    Eigen::MatrixX3d rays(static_cast<int>(pixels.size()), 3);
    Eigen::VectorXd inverse(rays.rows());
    for (int i = 0; i < rays.rows(); ++i) {
      const cv::Point p = pixels[static_cast<size_t>(i)];
      rays.row(i) = view.RayOf(p.x, p.y);
      inverse[i] = 1.0 / view.z_m(p);
    }
    const Eigen::Vector3d plane = rays.colPivHouseholderQr().solve(inverse);
    const Eigen::VectorXd off = inverse - rays * plane;
    residuals.setTo(std::nan(""));
    std::vector<cv::Point> kept;
    constexpr double kGross = 8e-3;  // [1/m]: wrong matches are not noise.
    for (int i = 0; i < rays.rows(); ++i) {
      if (std::abs(off[i]) > kGross) continue;
      kept.push_back(pixels[static_cast<size_t>(i)]);
      residuals(kept.back() - block.tl()) = off[i];
    }
    if (kept.size() < 0.97 * static_cast<double>(pixels.size())) return std::nullopt;
    pixels = std::move(kept);
  }
  return residuals;
}

// Sums of a block's residuals.
struct BlockSums {
  double products = 0.0;  // Of pixels a lag apart.
  int pairs = 0;
  double squares = 0.0;
  int values = 0;

  BlockSums& operator+=(const BlockSums& other) {
    products += other.products;
    pairs += other.pairs;
    squares += other.squares;
    values += other.values;
    return *this;
  }
  BlockSums Without(const BlockSums& other) const {
    return {products - other.products, pairs - other.pairs, squares - other.squares,
            values - other.values};
  }
  double Correlation() const { return (products / pairs) / (squares / values); }
};

BlockSums SumsOf(const cv::Mat1d& block, cv::Point lag) {
  BlockSums sums;
  for (int v = 0; v < block.rows; ++v) {
    for (int u = 0; u < block.cols; ++u) {
      if (std::isnan(block(v, u))) continue;
      sums.squares += block(v, u) * block(v, u);
      ++sums.values;
      if (v + lag.y >= block.rows || u + lag.x >= block.cols) continue;
      const double other = block(v + lag.y, u + lag.x);
      if (std::isnan(other)) continue;
      sums.products += block(v, u) * other;
      ++sums.pairs;
    }
  }
  return sums;
}

Estimated CorrelationOf(const std::vector<cv::Mat1d>& blocks, cv::Point lag) {
  std::vector<BlockSums> sums;
  BlockSums all;
  for (const cv::Mat1d& block : blocks) all += sums.emplace_back(SumsOf(block, lag));
  // The jackknife: blocks are left out one by one.
  const auto count = static_cast<double>(blocks.size());
  double squares = 0.0;
  for (const BlockSums& block : sums) {
    squares += std::pow(all.Without(block).Correlation() - all.Correlation(), 2);
  }
  return {all.Correlation(), std::sqrt((count - 1.0) / count * squares)};
}

// With the standard error of a normal sample's median.
Estimated MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = *middle;
  if (values.size() < 2) return {median, std::nan("")};
  return {median, std::sqrt(0.5 * std::numbers::pi) * StandardErrorOfMean(values)};
}

// Matched blocks have nine rows: no more than every ninth row is independent.
Estimated MeanOfRows(const std::vector<double>& rows) {
  constexpr double kBlockRows = 9.0;
  const double error = rows.size() < 2 ? 0.0 : StandardErrorOfMean(rows);
  return {Mean(rows), std::sqrt(kBlockRows) * error};
}

}  // namespace

Eigen::Vector3d FitPlane(const DepthView& view, const cv::Mat1b& mask) {
  constexpr double kTolerance = 3.5e-3;  // [1/m]: little more than a step.
  std::vector<cv::Point> pixels;
  cv::findNonZero(mask & (view.z_m > 0.0), pixels);
  const auto off = [&](const Eigen::Vector3d& plane, cv::Point p) {
    return std::abs(plane.dot(view.RayOf(p.x, p.y)) - 1.0 / view.z_m(p));
  };
  const RandomStream stream(1);
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  int64_t most = -1;
  for (uint64_t i = 0; i < 200; ++i) {
    Eigen::Matrix3d rays;
    Eigen::Vector3d inverse;
    for (int k = 0; k < 3; ++k) {
      const double share = stream.Uniform(3 * i + static_cast<uint64_t>(k));
      const cv::Point p = pixels[static_cast<size_t>(share * static_cast<double>(pixels.size()))];
      rays.row(k) = view.RayOf(p.x, p.y);
      inverse[k] = 1.0 / view.z_m(p);
    }
    if (std::abs(rays.determinant()) < 1e-9) continue;
    const Eigen::Vector3d plane = rays.inverse() * inverse;
    const auto near = std::count_if(pixels.begin(), pixels.end(),
                                    [&](cv::Point p) { return off(plane, p) < kTolerance; });
    if (near > most) {
      most = near;
      best = plane;
    }
  }
  for (int round = 0; round < 3; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const cv::Point p : pixels) {
      if (off(best, p) >= kTolerance) continue;
      const Eigen::Vector3d ray = view.RayOf(p.x, p.y);
      normal += ray * ray.transpose();
      right += ray / view.z_m(p);
    }
    best = normal.inverse() * right;
  }
  return best;
}

PlaneFigures Measure(const DepthView& view, const cv::Mat1b& mask, const Eigen::Vector3d& plane,
                     double step) {
  PlaneFigures figures;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask(v, u) == 0) continue;
      const Eigen::Vector3d ray = view.RayOf(u, v);
      const double z_m = 1.0 / plane.dot(ray);
      const double incidence_deg =
          std::acos(std::abs(plane.normalized().dot(ray.normalized()))) * 180.0 / std::numbers::pi;
      PlaneFigures::Bin& bin =
          figures.bins[{0.5 * std::floor(z_m / 0.5), 5.0 * std::floor(incidence_deg / 5.0)}];
      ++bin.pixels;
      if (view.z_m(v, u) > 0.0) ++bin.valid;
    }
  }
  const cv::Rect box = cv::boundingRect(mask);
  std::vector<cv::Mat1d> blocks;
  std::vector<double> noise;
  for (int v = box.y; v + kBlock <= box.br().y; v += kBlock) {
    for (int u = box.x; u + kBlock <= box.br().x; u += kBlock) {
      const cv::Rect block(u, v, kBlock, kBlock);
      if (cv::countNonZero(mask(block)) < block.area()) continue;
      const auto residuals = BlockResiduals(view, block);
      if (!residuals) continue;
      double sum = 0.0;
      int count = 0;
      for (const double r : *residuals) {
        if (std::isnan(r)) continue;
        sum += r * r;
        ++count;
      }
      noise.push_back(std::sqrt(sum / count) / step);
      blocks.push_back(*residuals);
    }
  }
  figures.blocks = static_cast<int>(blocks.size());
  if (blocks.empty()) return figures;
  figures.noise_steps = MedianOf(std::move(noise));
  for (int lag = 1; lag <= 3; ++lag) {
    figures.along_rows[static_cast<size_t>(lag - 1)] = CorrelationOf(blocks, {lag, 0});
    figures.along_columns[static_cast<size_t>(lag - 1)] = CorrelationOf(blocks, {0, lag});
  }
  return figures;
}

double StepOfDepths(const DepthView& view) {
  std::set<double> levels;
  for (const double z_m : view.z_m) {
    if (z_m >= 1.5 && z_m <= 4.0) levels.insert(1.0 / z_m);
  }
  if (levels.size() < 3) return std::nan("");
  std::vector<double> gaps;
  for (auto next = std::next(levels.begin()); next != levels.end(); ++next) {
    gaps.push_back(*next - *std::prev(next));
  }
  const double gap = MedianOf(gaps).value;
  double steps = 0.0;
  for (const double g : gaps) steps += std::round(g / gap);
  return (*levels.rbegin() - *levels.begin()) / steps;
}

double SmoothError(const DepthView& view, const cv::Mat1b& mask, double step) {
  constexpr double kGross = 14e-3;  // [1/m]
  const Eigen::Vector3d plane = FitPlane(view, mask);
  double squares = 0.0;
  int count = 0;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask(v, u) == 0 || !(view.z_m(v, u) > 0.0)) continue;
      const double off = plane.dot(view.RayOf(u, v)) - 1.0 / view.z_m(v, u);
      if (std::abs(off) > kGross) continue;
      squares += off * off;
      ++count;
    }
  }
  const double noise = Measure(view, mask, plane, step).noise_steps.value;
  return std::sqrt(std::max(0.0, squares / count / (step * step) - noise * noise));
}

OutlineHoles MeasureOutlines(const DepthView& view, cv::Range rows, double nearer_than_m) {
  std::vector<double> left;
  std::vector<double> both;
  std::vector<double> near_m;
  std::vector<double> beyond_m;
  std::vector<double> half_px;
  for (int v = rows.start; v < rows.end; ++v) {
    const cv::Mat1d row = view.z_m.row(v);
    const auto is_near = [&](double z_m) { return z_m > 0.0 && z_m < nearer_than_m; };
    const int first = static_cast<int>(std::find_if(row.begin(), row.end(), is_near) - row.begin());
    if (first == row.cols) continue;
    int last = row.cols - 1;
    while (!is_near(row(0, last))) --last;
    int before = first - 1;
    while (before >= 0 && row(0, before) == 0.0) --before;
    int after = last + 1;
    while (after < row.cols && row(0, after) == 0.0) ++after;
    if (before < 0 || after == row.cols) continue;
    left.push_back(first - before - 1);
    both.push_back(left.back() + after - last - 1);
    near_m.push_back(0.5 * (row(0, first) + row(0, last)));
    beyond_m.push_back(0.5 * (row(0, before) + row(0, after)));
    half_px.push_back(0.5 * (last - first + 1));
  }
  if (left.empty()) return {};
  return {static_cast<int>(left.size()),
          MeanOfRows(left),
          MeanOfRows(both),
          Mean(near_m),
          Mean(beyond_m),
          Mean(half_px)};
}

}  // namespace fenestra::validation

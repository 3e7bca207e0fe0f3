#include "tests/sim/structured_light/recorded_planes.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/io/image_io.h"
#include "core/random/random_stream.h"

namespace fenestra::testing {
namespace {

constexpr int kBlock = 32;
constexpr double kStepOfKinect = 2.92e-3;
constexpr double kStepOfTum = 2.71e-3;  // The benchmark scales its depths.

RecordedPlane Pcl(const std::string& frame, const std::string& what,
                  std::vector<cv::Point> polygon) {
  return {frame + " " + what,
          "depth-pcl/" + frame + "-depth.png",
          1e-3,
          525.0,
          {319.5, 239.5},
          kStepOfKinect,
          std::move(polygon)};
}

RecordedPlane Tum(const std::string& what, std::vector<cv::Point> polygon) {
  return {"freiburg2 " + what, "rgbd-tum/second_depth.png", 2e-4, 520.9, {325.1, 249.7},
          kStepOfTum,          std::move(polygon)};
}

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

}  // namespace

const std::vector<RecordedPlane>& RecordedPlanes() {
  static const std::vector<RecordedPlane> planes = {
      Pcl("person", "wall", {{40, 40}, {440, 40}, {430, 140}, {170, 150}, {150, 270}, {40, 300}}),
      Pcl("person", "cupboard", {{372, 195}, {475, 195}, {475, 425}, {372, 425}}),
      Pcl("capture0003", "wall", {{370, 40}, {590, 40}, {590, 185}, {370, 185}}),
      Pcl("capture0005", "wall", {{510, 40}, {590, 40}, {590, 175}, {510, 175}}),
      Pcl("five_people", "back wall", {{230, 85}, {460, 85}, {460, 98}, {230, 98}}),
      Pcl("five_people", "floor", {{285, 345}, {330, 345}, {330, 470}, {290, 470}}),
      Pcl("region_growing_rgb", "near floor",
          {{20, 470},
           {590, 470},
           {590, 200},
           {560, 140},
           {470, 120},
           {445, 290},
           {300, 290},
           {300, 200},
           {20, 260}}),
      Pcl("region_growing_rgb", "far floor",
          {{325, 60}, {590, 60}, {590, 140}, {470, 120}, {330, 110}}),
      Tum("floor", {{458, 150}, {600, 160}, {610, 360}, {555, 255}, {455, 220}}),
      Tum("floor beyond", {{458, 118}, {600, 128}, {600, 160}, {458, 150}}),
      Tum("screen", {{228, 120}, {360, 120}, {360, 225}, {228, 225}})};
  return planes;
}

DepthView ViewOf(const RecordedPlane& recorded) {
  const cv::Mat1w raw =
      ReadDepthImage(std::filesystem::path(FENESTRA_SOURCE_DIR) / "tests/data" / recorded.file);
  DepthView view{cv::Mat1d(), recorded.focal_px, recorded.centre_px};
  raw.convertTo(view.z_m, CV_64F, recorded.unit_m);
  return view;
}

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
  std::nth_element(noise.begin(), noise.begin() + noise.size() / 2, noise.end());
  figures.noise_steps = noise[noise.size() / 2];
  for (int lag = 1; lag <= 3; ++lag) {
    figures.along_rows[static_cast<size_t>(lag - 1)] = CorrelationOf(blocks, {lag, 0});
    figures.along_columns[static_cast<size_t>(lag - 1)] = CorrelationOf(blocks, {0, lag});
  }
  return figures;
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
  const double noise = Measure(view, mask, plane, step).noise_steps;
  return std::sqrt(std::max(0.0, squares / count / (step * step) - noise * noise));
}

cv::Mat1b MaskIn(const RecordedPlane& recorded, const DepthView& view) {
  std::vector<cv::Point> polygon;
  for (const cv::Point& p : recorded.polygon) {
    const Eigen::Vector2d ray =
        (Eigen::Vector2d(p.x, p.y) - recorded.centre_px) / recorded.focal_px;
    const Eigen::Vector2d pixel = view.centre_px + view.focal_px * ray;
    polygon.emplace_back(static_cast<int>(std::lround(pixel.x())),
                         static_cast<int>(std::lround(pixel.y())));
  }
  cv::Mat1b mask = cv::Mat1b::zeros(view.z_m.size());
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{polygon}, 255);
  // Blocks of pixels beyond leave the image; of registered ones elsewhere than of others.
  constexpr int kBorder_px = 8;
  cv::rectangle(mask, {0, 0}, {mask.cols - 1, mask.rows - 1}, 0, 2 * kBorder_px);
  return mask;
}

}  // namespace fenestra::testing

#include "experiments/output/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace fenestra {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontScale = 0.42;
// Letters are drawn with this many bits below a pixel.
constexpr int kShift = 4;

const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kGrid(225, 225, 225);

enum class Anchor { kLeft, kCentre, kRight };

void Write(cv::Mat3b& canvas, const std::string& text, cv::Point place, Anchor anchor,
           double scale = kFontScale) {
  const cv::Size size = cv::getTextSize(text, kFont, scale, 1, nullptr);
  if (anchor == Anchor::kCentre) place.x -= size.width / 2;
  if (anchor == Anchor::kRight) place.x -= size.width;
  cv::putText(canvas, text, place, kFont, scale, kInk, 1, cv::LINE_AA);
}

// Centred on a column, but moved to the left where it would leave the part that ends at `right`.
void WriteWithin(cv::Mat3b& canvas, const std::string& text, cv::Point centre, int right) {
  const int width = cv::getTextSize(text, kFont, kFontScale, 1, nullptr).width;
  Write(canvas, text, {std::min(centre.x - width / 2, right - width - 2), centre.y}, Anchor::kLeft);
}

void WriteUpwards(cv::Mat3b& canvas, const std::string& text, cv::Point centre) {
  const cv::Size size = cv::getTextSize(text, kFont, kFontScale, 1, nullptr);
  cv::Mat3b strip = WhiteCanvas({size.width + 4, size.height + 8});
  Write(strip, text, {2, size.height + 2}, Anchor::kLeft);
  cv::Mat3b turned;
  cv::rotate(strip, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect place({centre.x - turned.cols / 2, centre.y - turned.rows / 2}, turned.size());
  const cv::Rect visible = place & cv::Rect({0, 0}, canvas.size());
  turned(visible - place.tl()).copyTo(canvas(visible));
}

double Fraction(const PlotAxis& axis, double value) {
  if (!axis.logarithmic) return (value - axis.low) / (axis.high - axis.low);
  return std::log(value / axis.low) / std::log(axis.high / axis.low);
}

std::vector<double> TicksOf(const PlotAxis& axis) {
  if (!axis.logarithmic) return RoundTicks(axis.low, axis.high, 6);
  std::vector<double> ticks;
  for (double decade = std::pow(10.0, std::floor(std::log10(axis.low)));
       decade <= axis.high * 1.001; decade *= 10.0) {
    if (decade >= axis.low * 0.999) ticks.push_back(decade);
  }
  return ticks;
}

cv::Point Fixed(cv::Point2d p) {
  return {static_cast<int>(std::lround(p.x * (1 << kShift))),
          static_cast<int>(std::lround(p.y * (1 << kShift)))};
}

}  // namespace

cv::Mat3b WhiteCanvas(cv::Size size) {
  return cv::Mat3b(size, cv::Vec3b(255, 255, 255));
}

std::vector<double> RoundTicks(double low, double high, int count) {
  const double raw = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double digit = raw / power;
  const double step = power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9);
  // Steps are not shorter than raw ones. Far from 0 they may be too short for a double to take.
  for (int i = 0; i <= count && (first + i) * step <= high + 1e-9 * step; ++i) {
    ticks.push_back((first + i) * step);
  }
  return ticks;
}

Plot::Plot(cv::Mat3b& canvas, const PlotLayout& layout)
    : canvas_(canvas),
      layout_(layout),
      inner_(layout.area.x + 66, layout.area.y + 28, layout.area.width - 84,
             layout.area.height - 72) {
  Write(canvas_, layout_.title, {inner_.x + inner_.width / 2, layout_.area.y + 18}, Anchor::kCentre,
        0.48);
  DrawTicks();
  cv::rectangle(canvas_, inner_, kInk, 1);
  Write(canvas_, layout_.x.label, {inner_.x + inner_.width / 2, inner_.br().y + 36},
        Anchor::kCentre);
  WriteUpwards(canvas_, layout_.y.label, {layout_.area.x + 12, inner_.y + inner_.height / 2});
}

void Plot::DrawTicks() const {
  for (const double tick : TicksOf(layout_.x)) {
    const int x = static_cast<int>(Place({tick, layout_.y.low}).x);
    cv::line(canvas_, {x, inner_.y}, {x, inner_.br().y}, kGrid, 1);
    WriteWithin(canvas_, fmt::format("{:g}", tick), {x, inner_.br().y + 17}, layout_.area.br().x);
  }
  for (const double tick : TicksOf(layout_.y)) {
    const int y = static_cast<int>(Place({layout_.x.low, tick}).y);
    cv::line(canvas_, {inner_.x, y}, {inner_.br().x, y}, kGrid, 1);
    Write(canvas_, fmt::format("{:g}", tick), {inner_.x - 5, y + 4}, Anchor::kRight);
  }
}

cv::Point2d Plot::Place(cv::Point2d point) const {
  return {inner_.x + Fraction(layout_.x, point.x) * inner_.width,
          inner_.br().y - Fraction(layout_.y, point.y) * inner_.height};
}

bool Plot::Contains(cv::Point2d point) const {
  return point.x >= layout_.x.low && point.x <= layout_.x.high && point.y >= layout_.y.low &&
         point.y <= layout_.y.high;
}

void Plot::Points(std::span<const cv::Point2d> points, const cv::Scalar& color,
                  const std::string& label) {
  for (const cv::Point2d& point : points) {
    if (!Contains(point)) continue;
    cv::circle(canvas_, Fixed(Place(point)), 5 << (kShift - 1), color, cv::FILLED, cv::LINE_AA,
               kShift);
  }
  AddToLegend(color, label);
}

void Plot::Line(std::span<const cv::Point2d> points, const cv::Scalar& color,
                const std::string& label, int thickness) {
  for (size_t i = 1; i < points.size(); ++i) {
    if (!Contains(points[i - 1]) || !Contains(points[i])) continue;
    cv::line(canvas_, Fixed(Place(points[i - 1])), Fixed(Place(points[i])), color, thickness,
             cv::LINE_AA, kShift);
  }
  AddToLegend(color, label);
}

void Plot::VerticalMark(double x, const std::string& label) {
  if (!(x >= layout_.x.low && x <= layout_.x.high)) return;  // Nor for NaN.
  const int column = static_cast<int>(Place({x, layout_.y.low}).x);
  constexpr int kDash = 6;
  for (int y = inner_.y; y < inner_.br().y; y += 2 * kDash) {
    cv::line(canvas_, {column, y}, {column, std::min(y + kDash, inner_.br().y)}, kInk, 1);
  }
  Write(canvas_, label, {column - 4, inner_.y + 14}, Anchor::kRight, 0.38);
}

void Plot::AddToLegend(const cv::Scalar& color, const std::string& label) {
  if (label.empty()) return;
  const cv::Point place(inner_.x + 12, inner_.y + 30 + 17 * legend_rows_++);
  cv::rectangle(canvas_, place - cv::Point(0, 8), place + cv::Point(14, 0), color, cv::FILLED);
  Write(canvas_, label, place + cv::Point(20, 0), Anchor::kLeft, 0.40);
}

}  // namespace fenestra

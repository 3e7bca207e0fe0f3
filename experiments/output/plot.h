#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

namespace fenestra {

struct PlotAxis {
  std::string label;
  double low;
  double high;
  bool logarithmic = false;  ///< Both ends must be positive then.
};

/// Where a plot goes on its canvas, labels and title included.
struct PlotLayout {
  cv::Rect area;
  std::string title;
  PlotAxis x;
  PlotAxis y;
};

/// A diagram with ticks, drawn on a part of a picture. Points outside the axes are not drawn.
class Plot {
 public:
  /// Keeps a reference to the canvas.
  Plot(cv::Mat3b& canvas, const PlotLayout& layout);

  void Points(std::span<const cv::Point2d> points, const cv::Scalar& color,
              const std::string& label = "");
  void Line(std::span<const cv::Point2d> points, const cv::Scalar& color,
            const std::string& label = "", int thickness = 2);
  /// A dashed line over the whole height, with a label at its top.
  void VerticalMark(double x, const std::string& label);

 private:
  cv::Point2d Place(cv::Point2d point) const;
  bool Contains(cv::Point2d point) const;
  void DrawTicks() const;
  void AddToLegend(const cv::Scalar& color, const std::string& label);

  cv::Mat3b& canvas_;
  PlotLayout layout_;
  cv::Rect inner_;
  int legend_rows_ = 0;
};

/// Colours that are told apart in print, too (Okabe & Ito 2008).
namespace plot_color {
inline const cv::Scalar kBlue(178, 114, 0);
inline const cv::Scalar kVermilion(0, 94, 213);
inline const cv::Scalar kGreen(115, 158, 0);
inline const cv::Scalar kGray(150, 150, 150);
}  // namespace plot_color

/// A white picture to draw plots on.
cv::Mat3b WhiteCanvas(cv::Size size);

/// Round numbers within [low, high], about `count` of them: 1, 2 or 5 times a power of ten apart.
std::vector<double> RoundTicks(double low, double high, int count);

}  // namespace fenestra

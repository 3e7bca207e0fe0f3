#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/report/envelope_report.h"

namespace fenestra {
namespace {

constexpr int kPanelWidth = 520;
constexpr int kPanelHeight = 380;
constexpr int kMostColumns = 3;

// After Okabe and Ito, as in plot_color; BGR.
const cv::Scalar kColors[] = {plot_color::kBlue,         plot_color::kVermilion,
                              plot_color::kGreen,        cv::Scalar(0, 159, 230),
                              cv::Scalar(167, 121, 204), cv::Scalar(233, 180, 86)};

// A boundary, in runs of neighbouring levels at which the requirement holds somewhere.
class Boundary {
 public:
  void Add(cv::Point2d point) {
    if (ended_) runs_.emplace_back();
    ended_ = false;
    runs_.back().push_back(point);
  }
  void End() { ended_ = true; }

  void Draw(Plot& plot, const cv::Scalar& color, const std::string& name, int width) const {
    if (runs_.empty()) plot.Line(std::vector<cv::Point2d>{}, color, name, width);  // Its legend.
    for (size_t i = 0; i < runs_.size(); ++i) {
      plot.Line(runs_[i], color, i == 0 ? name : "", width);
      plot.Points(runs_[i], color);
    }
  }

 private:
  std::vector<std::vector<cv::Point2d>> runs_;
  bool ended_ = true;
};

struct Panel {
  std::string title;
  std::map<std::string, Boundary> far;  ///< By detector.
  std::map<std::string, Boundary> near;
};

std::string FirstVariedNumber(std::span<const EnvelopeCurve> envelopes) {
  for (size_t i = 0; i < envelopes.front().curve.others.size(); ++i) {
    std::set<double> numbers;
    const std::string& name = envelopes.front().curve.others[i].first;
    for (const EnvelopeCurve& envelope : envelopes) {
      for (const auto& [other, value] : envelope.curve.others) {
        const double* number = std::get_if<double>(&value);
        if (other == name && number != nullptr) numbers.insert(*number);
      }
    }
    if (numbers.size() > 1) return name;
  }
  return "";
}

std::vector<Panel> Panels(std::span<const EnvelopeCurve> envelopes, const std::string& x_factor) {
  std::vector<Panel> panels;
  for (const EnvelopeCurve& envelope : envelopes) {
    std::string title = envelope.curve.part;
    std::optional<double> x;
    for (const auto& [name, value] : envelope.curve.others) {
      if (name == x_factor) {
        x = std::get<double>(value);
      } else {
        title += fmt::format(", {} {}", name, ToString(value));
      }
    }
    if (!x) continue;
    auto panel = std::find_if(panels.begin(), panels.end(),
                              [&title](const Panel& p) { return p.title == title; });
    if (panel == panels.end()) {
      panels.push_back({title, {}, {}});
      panel = panels.end() - 1;
    }
    auto& far = panel->far[envelope.detector];  // In the legend even where it holds nowhere.
    auto& near = panel->near[envelope.detector];
    if (envelope.holds.empty()) {
      far.End();
      near.End();
      continue;
    }
    far.Add({*x, envelope.holds.back().to});
    if (envelope.holds.front().fails_below) near.Add({*x, envelope.holds.front().from});
  }
  return panels;
}

struct Axes {
  PlotAxis x;
  PlotAxis y;
};

Axes AxesOf(const Study& study, std::span<const EnvelopeCurve> envelopes,
            const std::string& x_factor) {
  const std::string& over = study.parts[envelopes.front().curve.part_index].envelope->over;
  Axes axes{.x = {x_factor, 1e300, -1e300}, .y = {over, 0.0, 0.0}};
  for (const EnvelopeCurve& envelope : envelopes) {
    axes.y.high = std::max(axes.y.high, envelope.curve.level.back());
    axes.y.low = std::min(axes.y.low, envelope.curve.level.front());
    for (const auto& [name, value] : envelope.curve.others) {
      if (name != x_factor) continue;
      axes.x.low = std::min(axes.x.low, std::get<double>(value));
      axes.x.high = std::max(axes.x.high, std::get<double>(value));
    }
  }
  axes.x.logarithmic = axes.x.low > 0.0 && axes.x.high / axes.x.low > 30.0;
  return axes;
}

}  // namespace

std::optional<cv::Mat3b> EnvelopePicture(const Study& study,
                                         std::span<const EnvelopeCurve> envelopes) {
  if (envelopes.empty()) return std::nullopt;
  const std::string x_factor = FirstVariedNumber(envelopes);
  if (x_factor.empty()) return std::nullopt;
  const std::vector<Panel> panels = Panels(envelopes, x_factor);
  const Axes axes = AxesOf(study, envelopes, x_factor);
  std::map<std::string, cv::Scalar> colors;
  for (const EnvelopeCurve& envelope : envelopes) {
    colors.try_emplace(envelope.detector, kColors[colors.size() % std::size(kColors)]);
  }
  const auto count = static_cast<int>(panels.size());
  const int columns = std::min(kMostColumns, count);
  const int rows = (count + columns - 1) / columns;
  cv::Mat3b canvas = WhiteCanvas({columns * kPanelWidth, rows * kPanelHeight});
  for (int i = 0; i < count; ++i) {
    const Panel& panel = panels[static_cast<size_t>(i)];
    const cv::Rect area(i % columns * kPanelWidth, i / columns * kPanelHeight, kPanelWidth,
                        kPanelHeight);
    Plot plot(canvas, {.area = area, .title = panel.title, .x = axes.x, .y = axes.y});
    for (const auto& [detector, boundary] : panel.far) {
      boundary.Draw(plot, colors.at(detector), detector, 2);
    }
    for (const auto& [detector, boundary] : panel.near) {
      boundary.Draw(plot, colors.at(detector), "", 1);
    }
  }
  return canvas;
}

}  // namespace fenestra

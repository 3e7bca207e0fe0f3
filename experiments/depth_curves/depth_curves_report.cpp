#include "experiments/depth_curves/depth_curves_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/pose.h"
#include "experiments/depth_curves/depth_laws.h"
#include "experiments/depth_curves/wall_setup.h"
#include "experiments/output/text_table.h"

namespace fenestra {
namespace {

TextTable TableWith(const std::vector<std::string>& headings) {
  TextTable table;
  for (const std::string& heading : headings) table.AddColumn(heading);
  return table;
}

std::string Ratio(double x) {
  return std::isnan(x) ? "—" : fmt::format("{:.2f}", x);
}

std::string Number(double x) {
  return std::isnan(x) ? "—" : fmt::format("{:.3g}", x);
}
std::string Millimetres(double x_m) {
  return Number(1e3 * x_m);
}
std::string InPercent(double share) {
  return fmt::format("{:.1f}", 100.0 * share);
}

std::string ByDistance(const DepthCurves& p, const DepthCurves& s) {
  TextTable table =
      TableWith({"distance [m]", "Khoshelham [mm]", "parametric [mm]", "speckle [mm]",
                 "speckle, ratio", "temporal, parametric [mm]", "temporal, speckle [mm]",
                 "valid, parametric [%]", "valid, speckle [%]"});
  for (size_t i = 0; i < s.by_distance.size(); ++i) {
    const auto& a = p.by_distance[i];
    const auto& b = s.by_distance[i];
    const double published_m = KhoshelhamSigma(b.z_m);
    table.AddRow({Number(b.z_m), Millimetres(published_m), Millimetres(a.residual_m),
                  Millimetres(b.residual_m), Ratio(b.residual_m / published_m),
                  Millimetres(a.temporal_m), Millimetres(b.temporal_m), InPercent(a.valid),
                  InPercent(b.valid)});
  }
  return table.ToMarkdown();
}

std::string ByIncidence(const DepthCurves& p, const DepthCurves& s) {
  TextTable table = TableWith({"angle [deg]", "Nguyen [mm]", "parametric [mm]", "speckle [mm]",
                               "valid, parametric [%]", "valid, speckle [%]"});
  for (size_t i = 0; i < s.by_incidence.size(); ++i) {
    const auto& a = p.by_incidence[i];
    const auto& b = s.by_incidence[i];
    table.AddRow({Number(b.angle_rad / kDegree), Millimetres(NguyenSigma(1.5, b.angle_rad)),
                  Millimetres(a.residual_m), Millimetres(b.residual_m), InPercent(a.valid),
                  InPercent(b.valid)});
  }
  return table.ToMarkdown();
}

std::string LateralTable(const DepthCurves& p, const DepthCurves& s) {
  TextTable table =
      TableWith({"angle [deg]", "Nguyen [px]", "parametric, left [px]", "parametric, right [px]",
                 "speckle, left [px]", "speckle, right [px]"});
  for (size_t i = 0; i < s.lateral.size(); ++i) {
    const auto& a = p.lateral[i];
    const auto& b = s.lateral[i];
    table.AddRow({Number(b.angle_rad / kDegree),
                  fmt::format("{:.2f}", NguyenLateralSigma(b.angle_rad)),
                  fmt::format("{:.2f}", a.left_px), fmt::format("{:.2f}", a.right_px),
                  fmt::format("{:.2f}", b.left_px), fmt::format("{:.2f}", b.right_px)});
  }
  return table.ToMarkdown();
}

std::string StepTable(const DepthCurves& s) {
  TextTable table = TableWith(
      {"distance [m]", "Khoshelham [mm]", "1/8 px [mm]", "SDK's table [mm]", "1/16 px [mm]"});
  for (const DepthCurves::Step& step : s.steps) {
    table.AddRow({Number(step.z_m), Millimetres(OpenNiStep(step.z_m)), Millimetres(step.open_ni_m),
                  Millimetres(MicrosoftStep(step.z_m)), Millimetres(step.microsoft_m)});
  }
  return table.ToMarkdown();
}

// Shares of valid pixels by x, one curve for each level of something else.
struct ShareCurve {
  double level;
  std::vector<cv::Point2d> x_and_share;
};
template <typename Rows, typename Row>
std::vector<ShareCurve> SharesBy(const Rows& rows, double Row::*level, double Row::*x) {
  std::vector<ShareCurve> curves;
  for (const Row& row : rows) {
    auto same = std::find_if(curves.begin(), curves.end(),
                             [&](const ShareCurve& c) { return c.level == row.*level; });
    if (same == curves.end()) same = curves.insert(same, {row.*level, {}});
    same->x_and_share.emplace_back(row.*x, row.valid);
  }
  return curves;
}
std::vector<ShareCurve> AmbientCurves(const DepthCurves& curves) {
  return SharesBy(curves.by_ambient, &DepthCurves::Ambient::z_m, &DepthCurves::Ambient::wall_lx);
}
std::vector<ShareCurve> PaintCurves(const DepthCurves& curves) {
  return SharesBy(curves.by_paint, &DepthCurves::Paint::reflectance_830nm,
                  &DepthCurves::Paint::z_m);
}

// Both models' curves side by side; all have the same x.
std::string ShareTable(const std::string& x, const std::string& unit,
                       const std::vector<ShareCurve>& p, const std::vector<ShareCurve>& s) {
  std::vector<std::string> headings = {x};
  for (const ShareCurve& curve : s) {
    for (const char* model : {"parametric", "speckle"}) {
      headings.push_back(fmt::format("{}{}, {} [%]", Number(curve.level), unit, model));
    }
  }
  TextTable table = TableWith(headings);
  for (size_t i = 0; i < s.front().x_and_share.size(); ++i) {
    std::vector<std::string> row = {fmt::format("{:g}", s.front().x_and_share[i].x)};
    for (size_t k = 0; k < s.size(); ++k) {
      row.push_back(InPercent(p[k].x_and_share[i].y));
      row.push_back(InPercent(s[k].x_and_share[i].y));
    }
    table.AddRow(row);
  }
  return table.ToMarkdown();
}

std::string AmbientTables(const StructuredLightOptions& options, const DepthCurves& p,
                          const DepthCurves& s) {
  TextTable halves = TableWith(
      {"distance [m]", "predicted [lx]", "parametric [lx]", "speckle [lx]", "speckle, ratio"});
  const std::vector<ShareCurve> parametric = AmbientCurves(p);
  const std::vector<ShareCurve> speckle = AmbientCurves(s);
  for (size_t i = 0; i < speckle.size(); ++i) {
    const double z_m = speckle[i].level;
    const double predicted = PredictedAmbientLimit(options, WallSetup::kWhite, z_m);
    const double measured = HalfPoint(speckle[i].x_and_share);
    halves.AddRow({Number(z_m), Number(predicted), Number(HalfPoint(parametric[i].x_and_share)),
                   Number(measured), Ratio(measured / predicted)});
  }
  return fmt::format("Half of the pixels are lost at:\n\n{}\nPixels with a return:\n\n{}",
                     halves.ToMarkdown(),
                     ShareTable("on the wall [lx]", " m", parametric, speckle));
}

std::string PaintTables(const StructuredLightOptions& options, const DepthCurves& p,
                        const DepthCurves& s) {
  TextTable halves =
      TableWith({"reflectance at 830 nm", "predicted [m]", "parametric [m]", "speckle [m]"});
  const std::vector<ShareCurve> parametric = PaintCurves(p);
  const std::vector<ShareCurve> speckle = PaintCurves(s);
  for (size_t i = 0; i < speckle.size(); ++i) {
    const double rho = speckle[i].level;
    halves.AddRow({Number(rho), Number(PredictedReach(options, rho)),
                   Number(HalfPoint(parametric[i].x_and_share)),
                   Number(HalfPoint(speckle[i].x_and_share))});
  }
  return fmt::format(
      "Half of the pixels are lost at:\n\n{}\nPixels with a return, by reflectance:\n\n{}",
      halves.ToMarkdown(), ShareTable("distance [m]", "", parametric, speckle));
}

std::string ShadowTable(const StructuredLightOptions& options, const DepthCurves& p,
                        const DepthCurves& s) {
  TextTable table =
      TableWith({"plate [m]", "wall [m]", "geometry [px]", "left, parametric [px]",
                 "left, speckle [px]", "right, parametric [px]", "right, speckle [px]"});
  for (size_t i = 0; i < s.shadows.size(); ++i) {
    const auto& a = p.shadows[i];
    const auto& b = s.shadows[i];
    const double width_px = ShadowWidth(options, b.plate_m, b.wall_m);
    table.AddRow({Number(b.plate_m), Number(b.wall_m), fmt::format("{:.2f}", width_px),
                  fmt::format("{:.2f}", a.left_px), fmt::format("{:.2f}", b.left_px),
                  fmt::format("{:.2f}", a.right_px), fmt::format("{:.2f}", b.right_px)});
  }
  return table.ToMarkdown();
}

// The largest differences between the models.
struct Agreement {
  double share = 0.0;  ///< Difference of the shares of valid pixels.
  std::string share_at = "nowhere";
  double low_ratio = 1.0;  ///< Ratio of noise, parametric : speckle, on white walls up to 60°.
  double high_ratio = 1.0;
};
Agreement AgreementOf(const DepthCurves& p, const DepthCurves& s) {
  Agreement worst;
  const auto shares = [&](double a, double b, const std::string& at) {
    if (std::abs(a - b) <= worst.share) return;
    worst.share = std::abs(a - b);
    worst.share_at = at;
  };
  const auto noise = [&](double a, double b) {
    worst.low_ratio = std::min(worst.low_ratio, a / b);
    worst.high_ratio = std::max(worst.high_ratio, a / b);
  };
  for (size_t i = 0; i < s.by_distance.size(); ++i) {
    const auto& at = s.by_distance[i];
    shares(p.by_distance[i].valid, at.valid, fmt::format("a white wall at {} m", at.z_m));
    noise(p.by_distance[i].residual_m, at.residual_m);
  }
  for (size_t i = 0; i < s.by_ambient.size(); ++i) {
    const auto& at = s.by_ambient[i];
    shares(p.by_ambient[i].valid, at.valid, fmt::format("{} lx at {} m", at.wall_lx, at.z_m));
  }
  for (size_t i = 0; i < s.by_paint.size(); ++i) {
    const auto& at = s.by_paint[i];
    shares(p.by_paint[i].valid, at.valid,
           fmt::format("paint of {} at {} m", at.reflectance_830nm, at.z_m));
  }
  for (size_t i = 0; i < s.by_incidence.size(); ++i) {
    if (s.by_incidence[i].angle_rad > 60.5 * kDegree) break;
    noise(p.by_incidence[i].residual_m, s.by_incidence[i].residual_m);
  }
  return worst;
}

}  // namespace

std::string DepthCurvesMarkdown(const StructuredLightOptions& options,
                                const DepthCurves& parametric, const DepthCurves& speckle) {
  const Agreement worst = AgreementOf(parametric, speckle);
  return fmt::format(
      "# Depth of simulated walls\n\n![Curves](depth_curves.png)\n\n"
      "## White wall, by distance\n\n{}\n"
      "## White wall at 1.5 m, by angle of incidence\n\n{}\n"
      "## Upright borders of a plate at 1.5 m, by its angle\n\n{}\n"
      "## Steps between depths\n\n{}\n"
      "## Shadows\n\n{}\n"
      "## White wall, by ambient light\n\n{}\n"
      "## Paint\n\n{}\n"
      "## The models against each other\n\n"
      "Valid shares differ most, by {:.1f} points, at {}; noise of white walls up to 60°, "
      "parametric : speckle, lies between {:.2f} and {:.2f}.\n",
      ByDistance(parametric, speckle), ByIncidence(parametric, speckle),
      LateralTable(parametric, speckle), StepTable(speckle),
      ShadowTable(options, parametric, speckle), AmbientTables(options, parametric, speckle),
      PaintTables(options, parametric, speckle), 100.0 * worst.share, worst.share_at,
      worst.low_ratio, worst.high_ratio);
}

}  // namespace fenestra

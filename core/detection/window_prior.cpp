#include "core/detection/window_prior.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/pose.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

using Table = ParameterTable<WindowPrior>;

constexpr double kSigmas = 5.0;

void AddGeometry(Table& table) {
  table
      .Number("expected_width_m", FENESTRA_FIELD(expected_width_m), {0.0, 1000.0},
              "Known outer width of the window; 0: not known.")
      .Number("expected_height_m", FENESTRA_FIELD(expected_height_m), {0.0, 1000.0},
              "Known outer height of the window; 0: not known.")
      .Number("expected_size_sigma_m", FENESTRA_FIELD(expected_size_sigma_m), {1e-6, 10.0},
              "Standard deviation of the known width and height.")
      .Number("expected_aspect", FENESTRA_FIELD(expected_aspect), {0.0, 100.0},
              "Known ratio of the window's width to its height; 0: not known.")
      .Number("expected_aspect_tolerance", FENESTRA_FIELD(expected_aspect_tolerance), {1e-3, 1.0},
              "Largest relative departure from expected_aspect.")
      .Choice("expected_shape", FENESTRA_FIELD(expected_shape),
              {"any", "rectangle", "upright_rectangle"},
              "Known shape of the window; upright: not rolled in the image.")
      .Number("expected_angle_tolerance_deg", FENESTRA_FIELD(expected_angle_tolerance_rad),
              {0.1, 45.0, kDegree}, "Largest departure of a corner or a side from expected_shape.");
}

void AddColor(Table& table) {
  table
      .Integer("expected_red_dn", FENESTRA_FIELD(expected_red_dn), {-1, 255},
               "Red channel of the frame's known colour; -1: not known.")
      .Integer("expected_green_dn", FENESTRA_FIELD(expected_green_dn), {-1, 255},
               "Green channel of the frame's known colour; -1: not known.")
      .Integer("expected_blue_dn", FENESTRA_FIELD(expected_blue_dn), {-1, 255},
               "Blue channel of the frame's known colour; -1: not known.")
      .Integer("expected_color_tolerance_dn", FENESTRA_FIELD(expected_color_tolerance_dn), {0, 255},
               "Largest departure from that colour in any channel.");
}

void AddGrey(Table& table) {
  table
      .Number("expected_grey_ratio", FENESTRA_FIELD(expected_grey_ratio), {0.0, 1.0},
              "Known ratio of the frame's grey value to that of the wall; 0: not known.")
      .Number("expected_grey_tolerance", FENESTRA_FIELD(expected_grey_tolerance), {1e-3, 1.0},
              "Largest departure from expected_grey_ratio.");
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::optional<Miss> ObjectionToSize(const WindowPrior& prior, double width_m, double height_m,
                                    double side_share) {
  const double tolerance_m =
      std::max(side_share * std::min(prior.expected_width_m, prior.expected_height_m),
               kSigmas * prior.expected_size_sigma_m);
  if (std::abs(width_m - prior.expected_width_m) <= tolerance_m &&
      std::abs(height_m - prior.expected_height_m) <= tolerance_m) {
    return std::nullopt;
  }
  return Miss{"unexpected_size",
              fmt::format("{:.2f} x {:.2f} m instead of {:.2f} x {:.2f} m", width_m, height_m,
                          prior.expected_width_m, prior.expected_height_m)};
}

// side[i] runs from corner i to the next.
std::optional<Miss> ObjectionToAngles(const WindowPrior& prior,
                                      const std::array<Eigen::Vector3d, 4>& side) {
  const auto unexpected = [&prior](const char* what, double by_rad) {
    return Miss{"unexpected_shape",
                fmt::format("{} by {:.0f} deg; {:.0f} deg are allowed", what, by_rad / kDegree,
                            prior.expected_angle_tolerance_rad / kDegree)};
  };
  for (size_t i = 0; i < 4; ++i) {
    const double off = std::abs(Angle(side[i], side[(i + 1) % 4]) - 0.5 * std::numbers::pi);
    if (off > prior.expected_angle_tolerance_rad) return unexpected("a corner is off", off);
  }
  if (prior.expected_shape == ExpectedShape::kRectangle) return std::nullopt;
  const Eigen::Vector3d down = side[1] - side[3];
  const double roll = std::abs(std::atan2(down.x(), down.y()));
  if (roll > prior.expected_angle_tolerance_rad) return unexpected("rolled", roll);
  return std::nullopt;
}

}  // namespace

Table PriorParameters(SensorKind sensor) {
  Table table;
  AddGeometry(table);
  sensor == SensorKind::kRgbd ? AddColor(table) : AddGrey(table);
  return table;
}

bool IsPriorOption(const std::string& name) {
  return name.starts_with("expected_");
}

std::vector<std::string> FaultsOf(const WindowPrior& prior) {
  std::vector<std::string> faults;
  if ((prior.expected_width_m > 0.0) != (prior.expected_height_m > 0.0)) {
    faults.push_back("expected_width_m and expected_height_m must be given both or not at all");
  }
  const bool green = prior.expected_green_dn >= 0;
  const bool blue = prior.expected_blue_dn >= 0;
  if (prior.knows_color() != green || prior.knows_color() != blue) {
    faults.push_back(
        "expected_red_dn, expected_green_dn and expected_blue_dn must be given all or not at all");
  }
  if (faults.empty() && prior.knows_size() && prior.expected_aspect > 0.0) {
    const double aspect = prior.expected_width_m / prior.expected_height_m;
    if (std::abs(aspect / prior.expected_aspect - 1.0) > prior.expected_aspect_tolerance) {
      faults.push_back(fmt::format("expected_aspect {:g} contradicts {:g} x {:g} m",
                                   prior.expected_aspect, prior.expected_width_m,
                                   prior.expected_height_m));
    }
  }
  return faults;
}

std::optional<Miss> ObjectionOf(const WindowPrior& prior, const WindowEstimate& estimate,
                                double side_share) {
  std::array<Eigen::Vector3d, 4> side;
  for (size_t i = 0; i < 4; ++i) side[i] = estimate.p_CV[(i + 1) % 4] - estimate.p_CV[i];
  const double width_m = 0.5 * (side[0].norm() + side[2].norm());
  const double height_m = 0.5 * (side[1].norm() + side[3].norm());
  if (prior.knows_size()) {
    if (auto miss = ObjectionToSize(prior, width_m, height_m, side_share)) return miss;
  }
  if (prior.expected_aspect > 0.0) {
    const double aspect = width_m / height_m;
    // Written as !(<=) so that a window without height is refused.
    if (!(std::abs(aspect / prior.expected_aspect - 1.0) <= prior.expected_aspect_tolerance)) {
      return Miss{"unexpected_shape", fmt::format("width over height is {:.2f} instead of {:.2f}",
                                                  aspect, prior.expected_aspect)};
    }
  }
  if (prior.expected_shape == ExpectedShape::kAny) return std::nullopt;
  return ObjectionToAngles(prior, side);
}

std::optional<Miss> ObjectionOf(const WindowPrior& prior, double grey_ratio) {
  if (!prior.knows_grey() ||
      std::abs(grey_ratio - prior.expected_grey_ratio) <= prior.expected_grey_tolerance) {
    return std::nullopt;
  }
  return Miss{"unexpected_grey", fmt::format("the frame has {:.2f} of its wall's grey, not {:.2f}",
                                             grey_ratio, prior.expected_grey_ratio)};
}

cv::Mat1b ExpectedColor(const WindowPrior& prior, const cv::Mat3b& image) {
  FENESTRA_CHECK(prior.knows_color(), "a prior with a colour");
  const cv::Scalar color(prior.expected_blue_dn, prior.expected_green_dn, prior.expected_red_dn);
  const cv::Scalar tolerance = cv::Scalar::all(prior.expected_color_tolerance_dn);
  cv::Mat1b matching;
  cv::inRange(image, color - tolerance, color + tolerance, matching);
  return matching;
}

}  // namespace fenestra

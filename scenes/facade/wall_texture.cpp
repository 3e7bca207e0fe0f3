#include "scenes/facade/wall_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <opencv2/core.hpp>

#include "core/io/srgb.h"
#include "core/system/check.h"
#include "scenes/facade/wall_pattern.h"

namespace fenestra {
namespace {

// Rec. ITU-R BT.709.
constexpr glm::dvec3 kLuminance{0.2126, 0.7152, 0.0722};

// The texel value for each linear value, in fine steps.
class SrgbEncoder {
 public:
  SrgbEncoder() {
    for (size_t i = 0; i < code_.size(); ++i) {
      const double linear = static_cast<double>(i) / (static_cast<double>(code_.size()) - 1.0);
      code_[i] = static_cast<uint8_t>(std::lround(255.0 * SrgbFromLinear(linear)));
    }
    for (size_t i = 0; i < linear_.size(); ++i) {
      linear_[i] = LinearFromSrgb(static_cast<double>(i) / 255.0);
    }
  }

  uint8_t Encode(float linear) const {
    const float scaled = std::clamp(linear, 0.0f, 1.0f) * static_cast<float>(code_.size() - 1);
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): of what is not negative, and in less time.
    return code_[static_cast<size_t>(scaled + 0.5f)];
  }
  double Decode(uint8_t code) const { return linear_[code]; }

 private:
  std::array<uint8_t, 16384> code_{};
  std::array<double, 256> linear_{};
};

const SrgbEncoder& Encoder() {
  static const SrgbEncoder encoder;
  return encoder;
}

// Scales the pattern to zero mean and unit variance, with no value beyond kMostDeviation.
cv::Mat1f Standardised(cv::Mat1f pattern) {
  // Each round moves mean and variance less; after four they are right to 0.1 %.
  for (int round = 0; round < 4; ++round) {
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(pattern, mean, deviation);
    pattern = (pattern - mean[0]) / deviation[0];
    pattern = cv::max(cv::min(pattern, kMostDeviation), -kMostDeviation);
  }
  return pattern;
}

struct Coloured {
  cv::Mat1f lightness;  // 1 + contrast · pattern.
  const cv::Mat1f& grey;
  glm::dvec3 hue_rgb;

  // Linear, relative to the wall's mean luminance.
  glm::vec3 At(int v, int u) const {
    const float p = lightness(v, u);
    if (grey.empty()) return p * glm::vec3(hue_rgb);
    const float g = grey(v, u);
    return p * ((1.0f - g) * glm::vec3(hue_rgb) + glm::vec3(g));
  }
};

struct Encoded {
  Texture texture;
  glm::dvec3 peak{0.0};   // Of the relative reflectances, which texel values are multiples of.
  glm::dvec3 mean{0.0};   // Of the texels' linear values.
  double contrast = 0.0;  // Of the luminance that the texels stand for.
};

glm::dvec3 PeakOf(const Coloured& coloured) {
  glm::vec3 peak(0.0f);
  for (int v = 0; v < coloured.lightness.rows; ++v) {
    for (int u = 0; u < coloured.lightness.cols; ++u) peak = glm::max(peak, coloured.At(v, u));
  }
  return peak;
}

Encoded Encode(const Coloured& coloured) {
  const int rows = coloured.lightness.rows;
  const int columns = coloured.lightness.cols;
  Encoded encoded{.texture = {.name = "wall", .width_px = columns, .height_px = rows, .texels = {}},
                  .peak = PeakOf(coloured)};
  encoded.texture.texels.reserve(static_cast<size_t>(rows) * static_cast<size_t>(columns));
  const glm::vec3 per_peak = 1.0f / glm::vec3(encoded.peak);
  const glm::dvec3 weights = kLuminance * encoded.peak;
  const SrgbEncoder& encoder = Encoder();
  double sum = 0.0;
  double squares = 0.0;
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u) {
      const glm::vec3 linear = coloured.At(v, u) * per_peak;
      const glm::u8vec4 texel(encoder.Encode(linear.r), encoder.Encode(linear.g),
                              encoder.Encode(linear.b), 255);
      encoded.texture.texels.push_back(texel);
      const glm::dvec3 stored(encoder.Decode(texel.r), encoder.Decode(texel.g),
                              encoder.Decode(texel.b));
      encoded.mean += stored;
      const double luminance = glm::dot(weights, stored);
      sum += luminance;
      squares += luminance * luminance;
    }
  }
  const auto count = static_cast<double>(encoded.texture.texels.size());
  encoded.mean /= count;
  const double mean = sum / count;
  encoded.contrast = std::sqrt(std::max(squares / count - mean * mean, 0.0)) / mean;
  return encoded;
}

}  // namespace

std::string TextureObjection(const WallOptions& wall) {
  if (wall.texture_contrast == 0.0) return "";
  const double lightest = 1.0 + kMostDeviation * wall.texture_contrast;
  const glm::dvec3 hue = HueRgb(wall.paint.hue);
  const double visible = wall.paint.reflectance * std::max({hue.r, hue.g, hue.b, 1.0}) * lightest;
  if (visible > 1.0) {
    return fmt::format(
        "a wall of reflectance {} ({}) with a texture_contrast of {} would have to reflect {:.2f} "
        "of the light in its lightest places: lower one of them",
        wall.paint.reflectance, HueNames().at(static_cast<size_t>(wall.paint.hue)),
        wall.texture_contrast, visible);
  }
  // In the infra-red the texels' luminance counts. Its mean is the least where grey joints take the
  // peak of a colour that the hue has little of.
  double least_mean = 0.0;
  for (int c = 0; c < 3; ++c) {
    least_mean += kLuminance[c] * std::min(hue[c], 1.0) / (std::max(hue[c], 1.0) * lightest);
  }
  if (wall.finish != WallFinish::kBrick) least_mean = 1.0 / lightest;
  if (wall.paint.reflectance_830nm > least_mean) {
    return fmt::format(
        "a wall_reflectance_830nm of {} with a texture_contrast of {} would have to reflect more "
        "than all light in its lightest places: it can be up to {:.3f}",
        wall.paint.reflectance_830nm, wall.texture_contrast, least_mean);
  }
  return "";
}

TexturedWall MakeTexturedWall(const WallOptions& wall, const RandomStream& random) {
  FENESTRA_CHECK(wall.texture_contrast > 0.0, "a texture has contrast");
  const WallPattern pattern = MakeWallPattern(wall.finish, random);
  const cv::Mat1f standard = Standardised(pattern.lightness);
  // Rounding to 8 bits adds contrast; the second round makes up for it.
  double amplitude = wall.texture_contrast;
  Encoded encoded;
  for (int round = 0; round < 2; ++round) {
    const Coloured coloured{1.0 + amplitude * standard, pattern.grey, HueRgb(wall.paint.hue)};
    encoded = Encode(coloured);
    amplitude *= wall.texture_contrast / encoded.contrast;
  }
  const double luminance = glm::dot(kLuminance, encoded.peak * encoded.mean);
  const double texel_luminance = glm::dot(kLuminance, encoded.mean);
  TexturedWall textured{.texture = std::move(encoded.texture),
                        .material = {.name = "wall"},
                        .side_m = kPatternSide_m * wall.texture_scale};
  textured.material.reflectance_rgb =
      glm::vec3(glm::min(wall.paint.reflectance / luminance * encoded.peak, glm::dvec3(1.0)));
  textured.material.reflectance_830nm =
      static_cast<float>(std::min(wall.paint.reflectance_830nm / texel_luminance, 1.0));
  textured.material.texture = 0;
  return textured;
}

void LayTexture(double side_m, const glm::dvec2& shift, Mesh& mesh) {
  mesh.texture_coordinates.assign(mesh.positions_W.size(), glm::vec2(0.0f));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions_W[t.x];
    const glm::vec3 normal =
        glm::abs(glm::cross(mesh.positions_W[t.y] - a, mesh.positions_W[t.z] - a));
    const bool along_x = normal.x > normal.y && normal.x > normal.z;
    const bool along_y = normal.y > normal.x && normal.y > normal.z;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = mesh.positions_W[t[k]];
      glm::dvec2 on_wall_m(p.x, -p.y);
      if (along_x) on_wall_m = {p.z, -p.y};
      if (along_y) on_wall_m = {p.x, p.z};
      mesh.texture_coordinates[t[k]] = glm::vec2(on_wall_m / side_m + shift);
    }
  }
}

}  // namespace fenestra

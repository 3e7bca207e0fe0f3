#include "renderers/tracing/mip_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/io/srgb.h"

namespace fenestra {
namespace {

constexpr float kOne = 65535.0f;

std::array<uint16_t, 256> MakeDecoding() {
  std::array<uint16_t, 256> linear{};
  for (size_t i = 0; i < linear.size(); ++i) {
    const double value = LinearFromSrgb(static_cast<double>(i) / 255.0);
    linear[i] = static_cast<uint16_t>(std::lround(value * static_cast<double>(kOne)));
  }
  return linear;
}

// Four channels in one register, on any machine.
using Quad = float __attribute__((vector_size(16)));

Quad Load(const glm::u16vec4& texel) {
  using Shorts = uint16_t __attribute__((vector_size(8)));
  static_assert(sizeof(Shorts) == sizeof(glm::u16vec4));
  Shorts shorts;
  std::memcpy(&shorts, &texel, sizeof(shorts));
  using Ints = int32_t __attribute__((vector_size(16)));
  return __builtin_convertvector(__builtin_convertvector(shorts, Ints), Quad);
}

int Remainder(int i, int n) {
  if ((n & (n - 1)) == 0) return i & (n - 1);  // Most textures' sides are powers of two.
  const int r = i % n;
  return r < 0 ? r + n : r;
}

int Wrapped(int i, int n, Texture::Wrap wrap) {
  if (static_cast<unsigned>(i) < static_cast<unsigned>(n)) return i;
  switch (wrap) {
    case Texture::Wrap::kClampToEdge:
      return std::clamp(i, 0, n - 1);
    case Texture::Wrap::kMirroredRepeat: {
      const int r = Remainder(i, 2 * n);
      return r < n ? r : 2 * n - 1 - r;
    }
    case Texture::Wrap::kRepeat:
      break;
  }
  return Remainder(i, n);
}

// std::floor is a function call on the baseline instruction set. |x| < 2^31.
int FloorToInt(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

// log2 at powers of two, linear between them. It is too large by at most 0.09 of a level, which is
// not visible.
float RoughLog2(float x) {
  const auto bits = std::bit_cast<uint32_t>(x);
  return static_cast<float>(bits) * 0x1p-23f - 127.0f;
}

// Coordinates far from the texture would not fit into an int.
float Near(float x, Texture::Wrap wrap) {
  if (wrap == Texture::Wrap::kClampToEdge) return std::clamp(x, -1.0f, 2.0f);
  if (std::abs(x) < 1e9f) return x - 2.0f * static_cast<float>(FloorToInt(0.5f * x));
  return x - 2.0f * std::floor(0.5f * x);
}

}  // namespace

glm::vec4 MipMap::Level::At(int x, int y) const {
  const glm::u16vec4& texel =
      texels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  return glm::vec4(texel) * (1.0f / kOne);
}

MipMap::MipMap(const Texture& texture)
    : wrap_u_(texture.wrap_u), wrap_v_(texture.wrap_v), interpolated_(texture.interpolated) {
  static const std::array<uint16_t, 256> kDecoding = MakeDecoding();
  Level base{.width = texture.width_px, .height = texture.height_px, .texels = {}};
  base.texels.reserve(texture.texels.size());
  for (const glm::u8vec4& t : texture.texels) {
    base.texels.emplace_back(kDecoding[t.r], kDecoding[t.g], kDecoding[t.b], t.a * 257);
  }
  levels_.push_back(std::move(base));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    levels_.push_back(Halved(levels_.back()));
  }
}

MipMap::Level MipMap::Halved(const Level& level) {
  Level half{
      .width = std::max(level.width / 2, 1), .height = std::max(level.height / 2, 1), .texels = {}};
  half.texels.reserve(static_cast<size_t>(half.width) * static_cast<size_t>(half.height));
  for (int y = 0; y < half.height; ++y) {
    const int y1 = std::min(2 * y + 1, level.height - 1);
    for (int x = 0; x < half.width; ++x) {
      const int x1 = std::min(2 * x + 1, level.width - 1);
      const glm::vec4 mean = 0.25f * (level.At(2 * x, 2 * y) + level.At(x1, 2 * y) +
                                      level.At(2 * x, y1) + level.At(x1, y1));
      half.texels.emplace_back(mean * kOne + 0.5f);
    }
  }
  return half;
}

glm::vec4 MipMap::SampleLevel(const Level& level, glm::vec2 coordinates) const {
  const float x = coordinates.x * static_cast<float>(level.width) - 0.5f;
  const float y = coordinates.y * static_cast<float>(level.height) - 0.5f;
  const auto column = [&](int i) { return Wrapped(i, level.width, wrap_u_); };
  const auto row = [&](int i) { return Wrapped(i, level.height, wrap_v_); };
  if (!interpolated_) {
    return level.At(column(FloorToInt(x + 0.5f)), row(FloorToInt(y + 0.5f)));
  }
  const int x_low = FloorToInt(x);
  const int y_low = FloorToInt(y);
  const float s = x - static_cast<float>(x_low);
  const float t = y - static_cast<float>(y_low);
  const int x0 = column(x_low);
  const int x1 = column(x_low + 1);
  const int y0 = row(y_low);
  const int y1 = row(y_low + 1);
  const glm::u16vec4* top = level.Row(y0);
  const glm::u16vec4* low = level.Row(y1);
  const float w = t * s;
  const Quad mean = (1.0f - s - t + w) * Load(top[x0]) + (s - w) * Load(top[x1]) +
                    (t - w) * Load(low[x0]) + w * Load(low[x1]);
  return glm::vec4(mean[0], mean[1], mean[2], mean[3]) * (1.0f / kOne);
}

glm::vec4 MipMap::Sample(glm::vec2 coordinates, float width_texels) const {
  const glm::vec2 near(Near(coordinates.x, wrap_u_), Near(coordinates.y, wrap_v_));
  const float coarsest = static_cast<float>(levels_.size() - 1);
  const float level = std::clamp(RoughLog2(std::max(width_texels, 1.0f)), 0.0f, coarsest);
  const auto fine = static_cast<size_t>(level);
  const float between = level - static_cast<float>(fine);
  const glm::vec4 at_fine = SampleLevel(levels_[fine], near);
  if (between == 0.0f) return at_fine;
  return (1.0f - between) * at_fine + between * SampleLevel(levels_[fine + 1], near);
}

float MipMap::AlphaAt(glm::vec2 coordinates) const {
  const Level& level = levels_[0];
  const float x = Near(coordinates.x, wrap_u_) * static_cast<float>(level.width);
  const float y = Near(coordinates.y, wrap_v_) * static_cast<float>(level.height);
  return level
      .At(Wrapped(FloorToInt(x), level.width, wrap_u_),
          Wrapped(FloorToInt(y), level.height, wrap_v_))
      .a;
}

}  // namespace fenestra

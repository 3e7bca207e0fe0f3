#include "renderers/light/light_patches.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace fenestra {
namespace {

using glm::vec2;
using glm::vec3;

// Edges that are tried as a direction of the bounding rectangle; in buildings the first few agree.
constexpr size_t kMostDirections = 16;
// Triangles that are apart by less than this part of the patch may touch: more than what the place
// of a hit is off by rounding.
constexpr float kTouching = 1e-5f;

float Cross(const vec2& a, const vec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Triangles with equal positions and surfaces are numbered alike.
std::vector<uint32_t> NumberComponents(const TriangleSoup& soup,
                                       const std::vector<uint32_t>& surfaces) {
  std::vector<uint32_t> parent(soup.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&parent](uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  struct Corner {
    uint32_t surface;
    vec3 p_W;
    uint32_t triangle;
    auto Key() const { return std::tie(surface, p_W.x, p_W.y, p_W.z); }
  };
  std::vector<Corner> corners;
  corners.reserve(3 * soup.size());
  for (uint32_t t = 0; t < soup.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      corners.push_back({surfaces[t], soup.positions_W[soup.triangles[t][k]], t});
    }
  }
  std::ranges::sort(corners, [](const Corner& a, const Corner& b) { return a.Key() < b.Key(); });
  for (size_t i = 1; i < corners.size(); ++i) {
    if (corners[i].Key() != corners[i - 1].Key()) continue;
    const uint32_t a = find(corners[i].triangle);
    const uint32_t b = find(corners[i - 1].triangle);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<uint32_t> number(soup.size());
  for (uint32_t t = 0; t < soup.size(); ++t) number[t] = find(t);
  return number;
}

struct Rectangle {
  vec3 s;  // Unit directions.
  vec3 t;
  vec2 low{std::numeric_limits<float>::max()};
  vec2 high{std::numeric_limits<float>::lowest()};

  vec2 size() const { return high - low; }
};

Rectangle Bound(const TriangleSoup& soup, const std::vector<uint32_t>& triangles, const vec3& n,
                const vec3& along) {
  Rectangle r{.s = along, .t = glm::cross(n, along)};
  for (const uint32_t t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const vec3& p = soup.positions_W[soup.triangles[t][k]];
      const vec2 q(glm::dot(p, r.s), glm::dot(p, r.t));
      r.low = glm::min(r.low, q);
      r.high = glm::max(r.high, q);
    }
  }
  return r;
}

// The smallest one with a side along an edge, or level.
Rectangle SmallestBound(const TriangleSoup& soup, const std::vector<uint32_t>& triangles,
                        const vec3& n) {
  const vec3 helper = std::abs(n.y) < 0.99f ? vec3(0.0f, 1.0f, 0.0f) : vec3(0.0f, 0.0f, 1.0f);
  Rectangle best = Bound(soup, triangles, n, glm::normalize(glm::cross(helper, n)));
  size_t tried = 0;
  for (size_t i = 0; i < triangles.size() && tried < kMostDirections; ++i) {
    const glm::uvec3& corners = soup.triangles[triangles[i]];
    for (int k = 0; k < 3; ++k, ++tried) {
      const vec3 edge = soup.positions_W[corners[(k + 1) % 3]] - soup.positions_W[corners[k]];
      const vec3 in_plane = edge - glm::dot(edge, n) * n;
      if (!(glm::length(in_plane) > 0.0f)) continue;
      const Rectangle r = Bound(soup, triangles, n, glm::normalize(in_plane));
      // Of equal ones the first, whatever their rounding.
      if (r.size().x * r.size().y < 0.999f * best.size().x * best.size().y) best = r;
    }
  }
  return best;
}

}  // namespace

bool Contains(const PatchTriangle& triangle, const glm::vec2& point) {
  int signs = 0;
  for (size_t k = 0; k < 3; ++k) {
    const float side = Cross(triangle[(k + 1) % 3] - triangle[k], point - triangle[k]);
    if (side > 0.0f) signs |= 1;
    if (side < 0.0f) signs |= 2;
  }
  return signs != 3;
}

bool Overlap(const PatchTriangle& a, const PatchTriangle& b) {
  // Separating axes: each edge of one triangle has all of the other on its outer side.
  const auto separates = [](const PatchTriangle& p, const PatchTriangle& q) {
    const float area = Cross(p[1] - p[0], p[2] - p[0]);
    for (size_t k = 0; k < 3; ++k) {
      const vec2 edge = p[(k + 1) % 3] - p[k];
      float innermost = std::numeric_limits<float>::lowest();
      for (const vec2& corner : q) {
        const float inwards = Cross(edge, corner - p[k]);
        innermost = std::max(innermost, area < 0.0f ? -inwards : inwards);
      }
      if (innermost < -kTouching * glm::length(edge)) return true;
    }
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

LightPatches::LightPatches(const TriangleSoup& soup, const std::vector<uint32_t>& surfaces)
    : patch_of_(soup.size(), 0), in_patch_(soup.size()) {
  const std::vector<uint32_t> component = NumberComponents(soup, surfaces);
  std::vector<std::vector<uint32_t>> members(soup.size());
  for (uint32_t t = 0; t < soup.size(); ++t) {
    if (!soup.is_smooth(t)) members[component[t]].push_back(t);
  }
  for (uint32_t t = 0; t < soup.size(); ++t) {
    if (soup.is_smooth(t)) {
      AddTriangle(soup, t, surfaces[t]);
    } else if (!members[t].empty()) {
      AddRectangle(soup, std::move(members[t]), surfaces[t]);
    }
  }
}

void LightPatches::AddRectangle(const TriangleSoup& soup, std::vector<uint32_t> triangles,
                                uint32_t surface) {
  // Positions far from the origin keep their digits relative to a corner.
  const vec3 n = soup.normals_W[triangles.front()];
  const Rectangle bound = SmallestBound(soup, triangles, n);
  const vec3& any = soup.positions_W[soup.triangles[triangles.front()].x];
  LightPatch patch;
  patch.n_W = n;
  patch.surface = surface;
  patch.has_back = !soup.is_closed[triangles.front()];
  patch.origin_W = any + (bound.low.x - glm::dot(any, bound.s)) * bound.s +
                   (bound.low.y - glm::dot(any, bound.t)) * bound.t;
  // No triangle lacks area, but a sliver's rectangle may be rounded to a line.
  const vec2 size = glm::max(bound.size(), vec2(std::numeric_limits<float>::min()));
  patch.s_axis_W = size.x * bound.s;
  patch.t_axis_W = size.y * bound.t;
  patch.width_m = size.x;
  patch.height_m = size.y;
  const auto index = static_cast<uint32_t>(patches_.size());
  for (const uint32_t t : triangles) {
    patch_of_[t] = index;
    for (size_t k = 0; k < 3; ++k) {
      const vec3& p = soup.positions_W[soup.triangles[t][static_cast<glm::length_t>(k)]];
      const vec2 q(glm::dot(p, bound.s), glm::dot(p, bound.t));
      in_patch_[t][k] = glm::clamp((q - bound.low) / size, vec2(0.0f), vec2(1.0f));
    }
  }
  patch.triangles = std::move(triangles);
  patches_.push_back(std::move(patch));
}

void LightPatches::AddTriangle(const TriangleSoup& soup, uint32_t triangle, uint32_t surface) {
  const glm::uvec3& corners = soup.triangles[triangle];
  const vec3& a = soup.positions_W[corners.x];
  patch_of_[triangle] = static_cast<uint32_t>(patches_.size());
  in_patch_[triangle] = {vec2(0.0f, 0.0f), vec2(1.0f, 0.0f), vec2(0.0f, 1.0f)};
  const vec3 to_b = soup.positions_W[corners.y] - a;
  const vec3 to_c = soup.positions_W[corners.z] - a;
  patches_.push_back({.origin_W = a,
                      .s_axis_W = to_b,
                      .t_axis_W = to_c,
                      .n_W = soup.normals_W[triangle],
                      .width_m = glm::length(to_b),
                      .height_m = glm::length(to_c),
                      .triangles = {triangle},
                      .surface = surface,
                      .is_smooth = true,
                      .has_back = !soup.is_closed[triangle]});
}

}  // namespace fenestra

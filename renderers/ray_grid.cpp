#include "renderers/ray_grid.h"

#include <fmt/format.h>

#include "core/input_error.h"

namespace fenestra {

RayGrid::RayGrid(const CameraModel& camera) : camera_(camera) {
  const int columns = width_px() + 1;
  const int rows = height_px() + 1;
  corners_.reserve(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d pixel(column - 0.5, row - 0.5);
      const auto ray = camera_.UnprojectRay(pixel);
      if (!ray) {
        throw InputError("camera", fmt::format("the image's point ({}, {}) px lies outside the "
                                               "lens model's valid domain",
                                               pixel.x(), pixel.y()));
      }
      corners_.emplace_back(ray->head<2>().cast<float>());
    }
  }
}

}  // namespace fenestra

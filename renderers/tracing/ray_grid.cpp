#include "renderers/tracing/ray_grid.h"

#include <fmt/format.h>

#include "core/io/input_error.h"

namespace fenestra {

RayGrid::RayGrid(const CameraModel& camera) : camera_(camera) {
  const int columns = width_px() + 1;
  const int rows = height_px() + 1;
  corners_.reserve(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    // The last two rays; straight on from them lies a good guess at the next one.
    Eigen::Vector2d last = Eigen::Vector2d::Zero();
    Eigen::Vector2d last_but_one = Eigen::Vector2d::Zero();
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d pixel(column - 0.5, row - 0.5);
      const auto ray = column < 2 ? camera_.UnprojectRay(pixel)
                                  : camera_.UnprojectRay(pixel, 2.0 * last - last_but_one);
      if (!ray) {
        throw InputError("camera", fmt::format("the image's point ({}, {}) px lies outside the "
                                               "lens model's valid domain",
                                               pixel.x(), pixel.y()));
      }
      last_but_one = last;
      last = ray->head<2>();
      corners_.emplace_back(last.cast<float>());
    }
  }
}

}  // namespace fenestra

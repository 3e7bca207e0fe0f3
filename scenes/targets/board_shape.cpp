#include "scenes/targets/board_shape.h"

#include <algorithm>
#include <cmath>

#include "core/io/faults.h"
#include "core/system/check.h"

namespace fenestra {
namespace {

Eigen::VectorXd Normals(int count, const RandomStream& stream) {
  Eigen::VectorXd normals(count);
  for (int i = 0; i < count; ++i) normals[i] = stream.Normal(static_cast<uint64_t>(i));
  return normals;
}

// `place` counts squares from the board's border; the first line is at 1.
double Interpolated(const Eigen::VectorXd& errors_m, double place) {
  const double line = std::clamp(place - 1.0, 0.0, static_cast<double>(errors_m.size() - 1));
  const auto before = std::min(static_cast<Eigen::Index>(line), errors_m.size() - 2);
  return std::lerp(errors_m[before], errors_m[before + 1], line - static_cast<double>(before));
}

}  // namespace

void Validate(const BoardTolerances& t) {
  Faults faults("board tolerances");
  faults.Require(
      t.bow >= 0.0 && t.line_error >= 0.0 && t.print_scale >= 0.0 && t.print_anisotropy >= 0.0,
      "standard deviations must not be negative");
  faults.ThrowIfAny();
}

BoardShape::BoardShape(const CalibrationBoard& board, const BoardTolerances& tolerances,
                       const RandomStream& stream)
    : BoardShape(board, tolerances, Normals(Freedom(board), stream)) {}

BoardShape::BoardShape(const CalibrationBoard& board, const BoardTolerances& tolerances,
                       const Eigen::VectorXd& multiples)
    : board_(board) {
  FENESTRA_CHECK(multiples.size() == Freedom(board), "one multiple for each deviation");
  bow_ = tolerances.bow * multiples.head<3>();
  const double scale = tolerances.print_scale * multiples[3];
  const double half_anisotropy = 0.5 * tolerances.print_anisotropy * multiples[4];
  strain_ = {scale + half_anisotropy, scale - half_anisotropy};
  const double line_error_m = tolerances.line_error * board.square_m;
  column_errors_m_ = line_error_m * multiples.segment(5, board.corner_columns());
  row_errors_m_ = line_error_m * multiples.tail(board.corner_rows());
}

Eigen::Vector3d BoardShape::At(const Eigen::Vector2d& drawn) const {
  const Eigen::Vector2d size(board_.width_m(), board_.height_m());
  const Eigen::Vector2d q = drawn - 0.5 * size;
  const Eigen::Vector2d line_error(Interpolated(column_errors_m_, drawn.x() / board_.square_m),
                                   Interpolated(row_errors_m_, drawn.y() / board_.square_m));
  const Eigen::Vector2d in_plane = drawn + strain_.cwiseProduct(q) + line_error;
  const Eigen::Array2d s = 2.0 * q.array() / size.array();
  const Eigen::Vector3d shapes(s.x() * s.x(), s.y() * s.y(), s.x() * s.y());
  return {in_plane.x(), in_plane.y(), size.norm() * bow_.dot(shapes)};
}

}  // namespace fenestra

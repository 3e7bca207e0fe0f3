#include "scenes/targets/flat_targets.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/aruco.hpp>

#include "core/io/faults.h"
#include "core/system/check.h"
#include "scenes/mesh/solid_lattice.h"
#include "scenes/paint.h"

namespace fenestra {
namespace {

constexpr Solid kWall = 1;
constexpr Solid kBorder = 2;

// Only the front of this plate becomes surface.
constexpr double kPlate_m = 1.0;

void Check(const PaperTargetOptions& o) {
  Faults faults("paper_target");
  faults.RequirePositive("width_m", o.width_m);
  faults.RequirePositive("height_m", o.height_m);
  faults.RequirePositive("border_m", o.border_m);
  faults.RequirePositive("wall_width_m", o.wall_width_m);
  faults.RequirePositive("wall_height_m", o.wall_height_m);
  faults.Require(!(2.0 * o.border_m >= std::min(o.width_m, o.height_m)),
                 fmt::format("two borders of {} m do not fit into {} m x {} m", o.border_m,
                             o.width_m, o.height_m));
  faults.Require(!(o.width_m >= o.wall_width_m || o.height_m >= o.wall_height_m),
                 fmt::format("a target of {} m x {} m does not fit on a wall of {} m x {} m",
                             o.width_m, o.height_m, o.wall_width_m, o.wall_height_m));
  faults.RequireWithin("wall_reflectance", o.wall_reflectance, 0.0, 1.0);
  faults.RequireWithin("wall_reflectance_830nm", o.wall_reflectance_830nm, 0.0, 1.0);
  faults.RequireWithin("frame_reflectance", o.frame_reflectance, 0.0, 1.0);
  faults.RequireWithin("frame_reflectance_830nm", o.frame_reflectance_830nm, 0.0, 1.0);
  faults.ThrowIfAny();
}

// An upright rectangle of the plate, centred on the origin.
Box Plate(double width_m, double height_m) {
  return {{-0.5 * width_m, -0.5 * height_m, -kPlate_m}, {0.5 * width_m, 0.5 * height_m, 0.0}};
}

std::vector<float> Breaks(double wall_m, double target_m, double border_m) {
  const double inner_m = 0.5 * target_m - border_m;
  // Nothing stands before the plane, so that its sky light is uniform and large cells suffice.
  return DistinctBreaks(
      {-0.5 * wall_m, -0.5 * target_m, -inner_m, inner_m, 0.5 * target_m, 0.5 * wall_m});
}

constexpr Solid kBoardWall = 1;
constexpr Solid kWhite = 2;
constexpr Solid kBlack = 3;

// Only the front of this plate becomes surface.
constexpr double kBoardPlate_m = 1.0;

// A rectangle of the board's plane, in frame G [m].
struct Rectangle {
  double left;
  double top;
  double right;
  double bottom;
};

// The black rectangles on the white board: squares, and the black cells of markers.
std::vector<Rectangle> BlackRectangles(const CalibrationBoard& board) {
  std::vector<Rectangle> black;
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_100);
  constexpr int kCells = kMarkerCells + 2;  // A border of one black cell all around.
  const double cell_m = board.marker_m / kCells;
  const double margin_m = 0.5 * (board.square_m - board.marker_m);
  int marker = 0;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const double left = column * board.square_m;
      const double top = row * board.square_m;
      if ((row + column) % 2 == 0) {
        black.push_back({left, top, left + board.square_m, top + board.square_m});
        continue;
      }
      if (board.kind != BoardKind::kCharuco) continue;
      cv::Mat1b picture;
      dictionary->drawMarker(marker++, kCells, picture);
      for (int y = 0; y < kCells; ++y) {
        for (int x = 0; x < kCells; ++x) {
          if (picture(y, x) != 0) continue;
          const double cell_left = left + margin_m + x * cell_m;
          const double cell_top = top + margin_m + y * cell_m;
          black.push_back({cell_left, cell_top, cell_left + cell_m, cell_top + cell_m});
        }
      }
    }
  }
  return black;
}

// The part of the plate behind a rectangle of the board.
Box BoxOf(const Rectangle& r, const Pose& X_WG) {
  const Eigen::Vector3d top_left = X_WG * Eigen::Vector3d(r.left, r.top, 0.0);
  const Eigen::Vector3d bottom_right = X_WG * Eigen::Vector3d(r.right, r.bottom, 0.0);
  return {{top_left.x(), bottom_right.y(), -kBoardPlate_m}, {bottom_right.x(), top_left.y(), 0.0}};
}

// Moves what the lattice has on the board and its margin to where it is as made.
void Bend(const BoardShape& shape, const Pose& X_WG, std::vector<glm::vec3>& positions_W) {
  const CalibrationBoard& board = shape.board();
  const double margin_m = 1.001 * board.square_m;  // Positions are rounded to single precision.
  const Pose X_GW = X_WG.inverse();
  for (glm::vec3& position : positions_W) {
    const Eigen::Vector3d p_GQ = X_GW * Eigen::Vector3d(position.x, position.y, position.z);
    if (p_GQ.x() < -margin_m || p_GQ.x() > board.width_m() + margin_m || p_GQ.y() < -margin_m ||
        p_GQ.y() > board.height_m() + margin_m) {
      continue;
    }
    const Eigen::Vector3d made = X_WG * shape.At(p_GQ.head<2>());
    position = glm::vec3(made.x(), made.y(), made.z());
  }
}

void Check(const BoardSceneOptions& o) {
  Validate(o.board);
  FENESTRA_CHECK(!o.shape || o.shape->board() == o.board, "the shape is that of another board");
  Faults faults("board_scene");
  const double margin_m = 2.0 * o.board.square_m;
  faults.Require(
      !(o.board.width_m() + margin_m >= o.wall_width_m ||
        o.board.height_m() + margin_m >= o.wall_height_m),
      fmt::format("a board of {} m x {} m with its margin does not fit on a wall of {} m "
                  "x {} m",
                  o.board.width_m(), o.board.height_m(), o.wall_width_m, o.wall_height_m));
  faults.RequireWithin("white_reflectance", o.white_reflectance, 0.0, 1.0);
  faults.RequireWithin("black_reflectance", o.black_reflectance, 0.0, 1.0);
  faults.RequireWithin("wall_reflectance", o.wall_reflectance, 0.0, 1.0);
  faults.ThrowIfAny();
}

}  // namespace

Scene MakePaperTarget(const PaperTargetOptions& options) {
  Check(options);
  const PaperTargetOptions& o = options;
  SolidLattice lattice({Breaks(o.wall_width_m, o.width_m, o.border_m),
                        Breaks(o.wall_height_m, o.height_m, o.border_m),
                        {static_cast<float>(-kPlate_m), 0.0f}});
  lattice.Fill(Plate(o.wall_width_m, o.wall_height_m), kWall);

  Scene scene;
  scene.materials.push_back(MaterialOf("wall", {o.wall_reflectance, o.wall_reflectance_830nm}));
  if (o.with_target) {
    lattice.Fill(Plate(o.width_m, o.height_m), kBorder);
    lattice.Fill(Plate(o.width_m - 2.0 * o.border_m, o.height_m - 2.0 * o.border_m), kWall);
    scene.materials.push_back(
        MaterialOf("border", {o.frame_reflectance, o.frame_reflectance_830nm}));
    scene.target = {.X_WO = Pose(), .width_m = o.width_m, .height_m = o.height_m};
  }
  const SolidSurface surface = lattice.Surface(SolidLattice::Faces::kFrontOfLattice);
  scene.meshes.push_back(MeshOf(surface, kWall, "wall", 0));
  if (o.with_target) scene.meshes.push_back(MeshOf(surface, kBorder, "border", 1));
  return scene;
}

Pose BoardPose(const CalibrationBoard& board) {
  const Eigen::Matrix3d R_WG = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  return Pose(R_WG, {-0.5 * board.width_m(), 0.5 * board.height_m(), 0.0});
}

Scene MakeBoardScene(const BoardSceneOptions& options) {
  Check(options);
  const CalibrationBoard& board = options.board;
  const Pose X_WG = BoardPose(board);
  const Box wall{{-0.5 * options.wall_width_m, -0.5 * options.wall_height_m, -kBoardPlate_m},
                 {0.5 * options.wall_width_m, 0.5 * options.wall_height_m, 0.0}};
  const double margin_m = board.square_m;
  const Box white =
      BoxOf({-margin_m, -margin_m, board.width_m() + margin_m, board.height_m() + margin_m}, X_WG);
  std::vector<std::pair<Box, Solid>> boxes = {{wall, kBoardWall}, {white, kWhite}};
  for (const Rectangle& r : BlackRectangles(board)) boxes.emplace_back(BoxOf(r, X_WG), kBlack);

  std::vector<double> x;
  std::vector<double> y;
  for (const auto& [box, solid] : boxes) {
    x.insert(x.end(), {box.low.x(), box.high.x()});
    y.insert(y.end(), {box.low.y(), box.high.y()});
  }
  SolidLattice lattice(
      {DistinctBreaks(x), DistinctBreaks(y), {static_cast<float>(-kBoardPlate_m), 0.0f}});
  for (const auto& [box, solid] : boxes) lattice.Fill(box, solid);

  Scene scene;
  SolidSurface surface = lattice.Surface(SolidLattice::Faces::kFrontOfLattice);
  if (options.shape) Bend(*options.shape, X_WG, surface.positions_W);
  const auto add = [&](Solid solid, const std::string& name, double reflectance) {
    scene.meshes.push_back(
        MeshOf(surface, solid, name, static_cast<uint32_t>(scene.materials.size())));
    scene.materials.push_back(MaterialOf(name, {reflectance, reflectance}));
  };
  add(kBoardWall, "wall", options.wall_reflectance);
  add(kWhite, "board_white", options.white_reflectance);
  add(kBlack, "board_black", options.black_reflectance);
  return scene;
}

}  // namespace fenestra

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "core/io/input_error.h"
#include "experiments/cli/commands.h"
#include "experiments/rig_calibration/board_pictures.h"
#include "experiments/rig_calibration/calibration_report.h"

namespace fenestra::cli {
namespace {

struct CalibrateArguments {
  std::vector<std::string> left;
  std::vector<std::string> right;
  std::string corners;  ///< "9x6": inner ones.
  double square_mm = 0.0;
  bool charuco = false;
  double marker_mm = 0.0;
  bool free_k3 = false;
  std::filesystem::path out;
};

struct Corners {
  int columns = 0;
  int rows = 0;
};

// "9x6". Numbers too large for a board are refused by Validate, those too large for an int here.
Corners CornersIn(const std::string& text) {
  Corners corners;
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, corners.columns);
  const bool has_x = columns.ec == std::errc() && columns.ptr != end && *columns.ptr == 'x';
  const auto rows = has_x ? std::from_chars(columns.ptr + 1, end, corners.rows) : columns;
  constexpr int kMost = 1000;
  if (!has_x || rows.ec != std::errc() || rows.ptr != end || corners.columns > kMost ||
      corners.rows > kMost) {
    throw InputError("--corners",
                     fmt::format("'{}' is not COLUMNSxROWS of inner corners, like 9x6", text));
  }
  return corners;
}

CalibrationBoard BoardOf(const CalibrateArguments& arguments) {
  const auto [columns, rows] = CornersIn(arguments.corners);
  if (arguments.charuco && !(arguments.marker_mm > 0.0)) {
    throw InputError("--marker-mm", "a ChArUco board needs the side of its markers");
  }
  CalibrationBoard board{.kind = arguments.charuco ? BoardKind::kCharuco : BoardKind::kChessboard,
                         .columns = columns + 1,
                         .rows = rows + 1,
                         .square_m = 1e-3 * arguments.square_mm,
                         .marker_m = 1e-3 * arguments.marker_mm};
  Validate(board);
  return board;
}

void Calibrate(const CalibrateArguments& arguments) {
  const CalibrationBoard board = BoardOf(arguments);
  const OutputPath out = OutputPath::Folder(arguments.out);
  out.RequireWritable();
  out.RequireFree(kCalibrationFiles);
  const auto pairs = PairUp(ImageFiles(arguments.left), ImageFiles(arguments.right));
  const StereoCalibrationResult result =
      CalibrateFromPictures(pairs, board, {.free_k3 = arguments.free_k3});
  WriteCalibration(out, result, board);
  fmt::print("{}\nIn {}: {}\n", CalibrationReport(result, board, ReportFormat::kPlain),
             arguments.out.string(), fmt::join(kCalibrationFiles, ", "));
}

}  // namespace

void AddCalibrateCommand(Command program) {
  Command calibrate =
      program.AddCommand("calibrate", "Calibrates a real rig from pictures of a board");
  calibrate.RequireCommand();
  const std::string example =
      "Example:\n"
      "  fenestra calibrate stereo --left 'left*.png' --right 'right*.png' --corners 9x6 "
      "--square-mm 30 --out rig";
  calibrate.Footer(example);

  Command stereo = calibrate.AddCommand(
      "stereo", "Both cameras of a pair and the pose between them, with their covariance");
  stereo.Footer(example +
                "\n10 to 20 pairs are usual: the board tilted in different directions, near and "
                "far,\nand all over both images.");
  const auto arguments = std::make_shared<CalibrateArguments>();
  stereo.AddOption("--left", arguments->left, "Left pictures: files, a folder or a pattern")
      .Required();
  stereo
      .AddOption("--right", arguments->right,
                 "Right pictures, paired with the left ones in the order of their names")
      .Required();
  stereo.AddOption("--corners", arguments->corners, "Inner corners, COLUMNSxROWS").Required();
  stereo.AddOption("--square-mm", arguments->square_mm, "Side of a square").Required().Positive();
  stereo.AddFlag("--charuco", arguments->charuco, "A ChArUco board of DICT_5X5_100");
  stereo.AddOption("--marker-mm", arguments->marker_mm, "Side of a ChArUco marker").Positive();
  stereo.AddFlag("--free-k3", arguments->free_k3,
                 "Estimate k3, too: for lenses with strong distortion and many views");
  stereo.AddOption("--out", arguments->out, "Folder for the results").Required();
  stereo.Action([arguments] {
    Calibrate(*arguments);
    return kDone;
  });
}

}  // namespace fenestra::cli

#include <fmt/format.h>

#include <filesystem>

#include "core/input_error.h"
#include "experiments/board_pictures.h"
#include "experiments/calibration_report.h"
#include "experiments/cli/commands.h"

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

CalibrationBoard BoardOf(const CalibrateArguments& arguments) {
  int columns = 0;
  int rows = 0;
  char rest = 0;
  if (std::sscanf(arguments.corners.c_str(), "%dx%d%c", &columns, &rows, &rest) != 2) {
    throw InputError("--corners", fmt::format("'{}' is not COLUMNSxROWS of inner corners, like 9x6",
                                              arguments.corners));
  }
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
  const auto pairs = PairUp(ImageFiles(arguments.left), ImageFiles(arguments.right));
  const StereoCalibrationResult result =
      CalibrateFromPictures(pairs, board, {.free_k3 = arguments.free_k3});
  WriteCalibration(arguments.out, result, board);
  fmt::print(
      "{}\nIn {}: stereo.yaml, left.yaml, right.yaml, report.md, covariance.csv, "
      "residuals.png\n",
      CalibrationReport(result, board, ReportFormat::kPlain), arguments.out.string());
}

}  // namespace

void AddCalibrateCommand(CLI::App& program, int& exit_code) {
  CLI::App* calibrate =
      program.add_subcommand("calibrate", "Calibrates a real rig from pictures of a board");
  calibrate->require_subcommand(1);
  const std::string example =
      "Example:\n"
      "  fenestra calibrate stereo --left 'left*.png' --right 'right*.png' --corners 9x6 "
      "--square-mm 30 --out rig";
  calibrate->footer(example);

  CLI::App* stereo = calibrate->add_subcommand(
      "stereo", "Both cameras of a pair and the pose between them, with their covariance");
  stereo->footer(example +
                 "\n10 to 20 pairs are usual: the board tilted in different directions, near and "
                 "far,\nand all over both images.");
  const auto arguments = std::make_shared<CalibrateArguments>();
  stereo->add_option("--left", arguments->left, "Left pictures: files, a folder or a pattern")
      ->required();
  stereo
      ->add_option("--right", arguments->right,
                   "Right pictures, paired with the left ones in the order of their names")
      ->required();
  stereo->add_option("--corners", arguments->corners, "Inner corners, COLUMNSxROWS")->required();
  stereo->add_option("--square-mm", arguments->square_mm, "Side of a square")
      ->required()
      ->check(CLI::PositiveNumber);
  stereo->add_flag("--charuco", arguments->charuco, "A ChArUco board of DICT_5X5_100");
  stereo->add_option("--marker-mm", arguments->marker_mm, "Side of a ChArUco marker")
      ->check(CLI::PositiveNumber);
  stereo->add_flag("--free-k3", arguments->free_k3,
                   "Estimate k3, too: for lenses with strong distortion and many views");
  stereo->add_option("--out", arguments->out, "Folder for the results")->required();
  stereo->callback([arguments, &exit_code] {
    Calibrate(*arguments);
    exit_code = kDone;
  });
}

}  // namespace fenestra::cli

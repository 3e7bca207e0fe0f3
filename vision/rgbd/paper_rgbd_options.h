#pragma once

#include <string>

#include "core/parameter_table.h"
#include "vision/window_prior.h"

namespace fenestra {

/// Every choice of the paper's RGB-D pipeline. The paper gives one figure, the threshold of 50.
struct PaperRgbdOptions {
  /// Algorithm 1: a pixel is dark if each of its channels is below this [8-bit sRGB].
  int dark_below_dn = 50;

  /// "all" dark pixels with depth, as in the paper, or only the "largest_component" of them, or
  /// "each_component" on its own: then the one with the best score is the estimate and the others
  /// go with it. The paper's target is the only dark thing in view, so there the three agree.
  std::string cloud = "all";

  /// Fewer points than this are not searched. A 1 m frame with a 0.1 m border seen from 8 m, twice
  /// the sensor's range, still covers some 400 pixels.
  int min_cloud_points = 100;

  /// Unseen pixels are free sight to infinity; without it NARF finds nothing on a frame alone.
  bool unseen_is_far = true;

  /// NARF's support size as a fraction of the cloud's own size, which is the side of the square
  /// that has the area of its convex hull. The paper knows no window size beforehand, and the two
  /// windows that were tried in its manner differ by a factor of 2.5.
  double support_fraction = 0.2;
  /// If positive, the support size itself, whatever the cloud's size.
  double support_size_m = 0.0;
  /// Upper limit of that fraction's support size, in pixels of the range image at the cloud's
  /// median depth. NARF's time grows with its square, to a minute where most of a room is dark. A
  /// window that fills the range image, 320 x 240 px, needs 0.2 √(320 · 240) = 55 px.
  double max_support_px = 60.0;
  /// Finer depth images enter the range image with every n-th pixel only, so that it is no wider
  /// than this: the width of the paper's depth image. Twice the width is four times the points,
  /// each with four times the pixels in its support: up to 16 times NARF's time.
  int max_range_image_width_px = 320;
  /// Smallest interest of a key point. PCL's default of 0.45 loses corners to the depth noise of a
  /// Kinect beyond 2.5 m; from 0.2 to 0.35 the corners of a frame are found up to 4 m, and key
  /// points that are too many do no harm, as the largest quadrilateral passes over them.
  double min_interest_value = 0.3;

  /// How far from the cloud's plane a point may lie and still belong to it: fixed part, and part
  /// that grows with z². The latter is 3.5 times the Kinect's 1.425e-3 z² (Khoshelham & Elberink
  /// 2012), the former stands for the flatness of a frame.
  double plane_tolerance_m = 0.005;
  double plane_tolerance_per_m = 0.005;

  /// What four points must be like to pass for a frame; wide limits that only refuse nonsense.
  /// Area of the quadrilateral over that of the cloud's convex hull: a frame's key points lie some
  /// per cent of its side inside of its corners.
  double min_area_fraction = 0.5;
  /// Shortest over longest side: windows are not slits.
  double min_side_ratio = 0.25;

  /// How much of the quadrilateral's middle may be dark and on its plane, see opening.h. 1, since
  /// the paper does not look: a dark board, or carpet, is a window to it. 0.5 refuses those.
  double max_filled_share = 1.0;
  /// How much of each side of the quadrilateral must be dark and on its plane. 0, since the paper
  /// does not look; a frame has nearly all, and half where its paint sends few dots back.
  double min_seen_share = 0.0;

  // For the covariance, see crossing_covariance.h.
  /// Where key points lie within NARF's support, as a share of its size. Before paint that sends
  /// all dots back it is 0.03 to 0.04.
  double key_point_sigma_share = 0.05;
  /// Little: where dots are missing key points are off by many times that, and the frame's own three
  /// residuals are all that tells.
  double key_point_sigma_weight = 0.5;
  /// A step of the Kinect's depth, per square of the depth (m/m²): 1/8 px of disparity.
  double depth_step_per_m = 0.00285;

  /// What is known beforehand; nothing by default. A known colour of the frame takes the place of
  /// dark_below_dn.
  WindowPrior prior;
};

/// Throws InputError with all faults.
void Validate(const PaperRgbdOptions& options);

const ParameterTable<PaperRgbdOptions>& PaperRgbdParameters();

}  // namespace fenestra

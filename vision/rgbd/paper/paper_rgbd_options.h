#pragma once

#include <string>

#include "core/detection/window_prior.h"
#include "core/io/parameter_table.h"

namespace fenestra {

/// Options of the paper's RGB-D pipeline, each with the reason for its default. The paper gives a
/// single value, the threshold of 50.
struct PaperRgbdOptions {
  /// Algorithm 1: a pixel is dark if each of its channels is below this [8-bit sRGB].
  int dark_below_dn = 50;

  /// Which dark pixels with depth are searched: "all", as in the paper, the "largest_component"
  /// only, or "each_component" separately, in which case the one with the best score is the
  /// estimate and names the others. The paper's target is the only dark object in view, so there
  /// the three choices agree.
  std::string cloud = "all";

  /// Clouds with fewer points than this are not searched. A 1 m frame with a 0.1 m border seen from
  /// 8 m, twice the sensor's range, still covers some 400 pixels.
  int min_cloud_points = 100;

  /// Whether pixels without depth count as an unobstructed view to infinity. If not, NARF finds
  /// nothing on a frame that stands alone.
  bool unseen_is_far = true;

  /// NARF's support size as a fraction of the cloud's own size, the side of the square with the
  /// area of its convex hull. The paper assumes no window size, and its method was tried on two
  /// windows whose sizes differ by a factor of 2.5.
  double support_fraction = 0.2;
  /// If positive, the support size itself, regardless of the cloud's size.
  double support_size_m = 0.0;
  /// Upper limit of the support size that follows from support_fraction, in pixels of the range
  /// image at the cloud's median depth. NARF's time grows with the square of the support size, up
  /// to a minute if most of a room is dark. A window that fills the range image, 320 x 240 px,
  /// needs 0.2 √(320 · 240) = 55 px.
  double max_support_px = 60.0;
  /// Finer depth images enter the range image with every n-th pixel only, so that it is no wider
  /// than this, the width of the paper's depth image. Twice the width means four times the points,
  /// each with four times the pixels in its support, and so up to 16 times NARF's time.
  int max_range_image_width_px = 320;
  /// Smallest interest of a key point. PCL's default of 0.45 loses corners to the depth noise of a
  /// Kinect beyond 2.5 m; with values from 0.2 to 0.35 the corners of a frame are found up to 4 m.
  /// Superfluous key points do no harm, since the largest quadrilateral ignores them.
  double min_interest_value = 0.3;

  /// Largest distance from the cloud's plane of a point that belongs to it: a fixed part, which
  /// allows for a frame that is not flat, and a part that grows with z², which is 3.5 times the
  /// Kinect's 1.425e-3 z² (Khoshelham & Elberink 2012).
  double plane_tolerance_m = 0.005;
  double plane_tolerance_per_m = 0.005;

  /// Requirements on four points to be accepted as a frame; the limits are wide and only refuse
  /// nonsense. This one is the area of the quadrilateral over that of the cloud's convex hull: a
  /// frame's key points lie a few per cent of its side inside its corners.
  double min_area_fraction = 0.5;
  /// Shortest side over longest side: windows are not slits.
  double min_side_ratio = 0.25;

  /// Largest share of the quadrilateral's middle that may be dark and on its plane, see
  /// FilledShare. The default of 1 follows the paper, which does not check, so that a dark board or
  /// carpet passes for a window; 0.5 refuses those.
  double max_filled_share = 1.0;
  /// Least share of each side of the quadrilateral that must be dark and on its plane. The default
  /// of 0 follows the paper, which does not check. A frame has nearly 1, and about 0.5 where its
  /// paint reflects few dots.
  double min_seen_share = 0.0;

  // Parameters of the covariance, see diagonals.h.
  /// Standard deviation of the key points' places, as a share of NARF's support size. On paint that
  /// reflects all dots it is 0.03 to 0.04.
  double key_point_sigma_share = 0.05;
  /// Weight of that value. It is small, since where dots are missing key points are off by many
  /// times that much and only the frame's own three residuals tell by how much.
  double key_point_sigma_weight = 0.5;
  /// Quantum of the Kinect's depth divided by the square of the depth [1/m]: 1/8 px of disparity.
  double depth_step_per_m = 0.00285;

  /// Prior knowledge of the window; none by default. A known colour of the frame replaces
  /// dark_below_dn.
  WindowPrior prior;
};

/// Throws InputError with all faults.
void Validate(const PaperRgbdOptions& options);

const ParameterTable<PaperRgbdOptions>& PaperRgbdParameters();

}  // namespace fenestra

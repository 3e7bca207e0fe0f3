#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace fenestra {

/// Words with one meaning each in this project, since computer vision and facades share several:
///
///   frame         a coordinate frame: three axes and an origin, named by a capital letter
///   window frame  the members around a window's panes: what is painted black on the wall
///   image         what a camera delivers
///   block         the pixels around one pixel that a matcher compares
///   bound         Cramér and Rao's, the least covariance that an unbiased estimator can have
///   limit         the value that a check holds a figure against
///
/// Axes and pixels: in a camera's frame C, +x is right, +y down and +z forward along the optical
/// axis. Integer (u, v) is the centre of a pixel, so that the image's borders are at −0.5 and
/// size − 0.5. Depth is z, never the length of a ray.

/// Coefficients of the Brown–Conrady lens model, in OpenCV's order and sign.
struct BrownConrady {
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  bool operator==(const BrownConrady&) const = default;
};

/// Parameters of a pinhole camera with a Brown–Conrady lens.
struct CameraParameters {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;  ///< Principal point; integer (u, v) is a pixel *centre*.
  double cy_px = 0.0;
  BrownConrady distortion;

  bool operator==(const CameraParameters&) const = default;
};

/// Pinhole camera with Brown–Conrady distortion. Frame C: +x right, +y down, +z forward.
///
///     x = X/Z,  y = Y/Z,  r² = x² + y²                                     (normalised image)
///     g(r) = 1 + k1 r² + k2 r⁴ + k3 r⁶
///     x' = x g + 2 p1 x y + p2 (r² + 2x²),   y' = y g + p1 (r² + 2y²) + 2 p2 x y
///     u = fx x' + cx,  v = fy y' + cy
///
/// Source: D. C. Brown, "Close-range camera calibration", 1971, as OpenCV's calib3d has it.
///
/// Valid domain: r ≤ max_radius(), the largest radius up to which r g(r) still grows (with a
/// slope of at least 0.01), and at most tan 80°. Beyond it the polynomial folds back and two rays
/// would share a pixel, so Project and UnprojectRay return nullopt there.
class CameraModel {
 public:
  /// Throws InputError unless the size and focal lengths are positive, everything is finite and
  /// the sizes are at most 16384.
  explicit CameraModel(const CameraParameters& parameters);

  /// A pinhole without distortion whose principal point is the image centre.
  static CameraModel Pinhole(int width_px, int height_px, double f_px);

  /// p_CQ [m] to pixel (u, v). nullopt for Z ≤ 0 or outside the valid domain. The pixel may lie
  /// outside the image; see Contains.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& p_CQ) const;

  /// Pixel and its first derivatives.
  struct Linearisation {
    Eigen::Vector2d pixel;
    Eigen::Matrix<double, 2, 3> by_point;  ///< By X, Y, Z [px/m].
    /// By fx, fy, cx, cy, k1, k2, p1, p2, k3: the order of ParameterVector.
    Eigen::Matrix<double, 2, 9> by_parameters;
  };
  /// Project with its derivatives; nullopt where Project is.
  std::optional<Linearisation> Linearise(const Eigen::Vector3d& p_CQ) const;

  /// fx, fy, cx, cy, k1, k2, p1, p2, k3.
  Eigen::Matrix<double, 9, 1> ParameterVector() const;
  /// This camera with other parameters, in that order.
  CameraModel WithParameters(const Eigen::Matrix<double, 9, 1>& parameters) const;

  /// Pixel to the direction (x, y, 1) of its ray in C. The inverse of Project to 1e-12 in the
  /// normalised image; nullopt where no ray of the valid domain meets the pixel.
  std::optional<Eigen::Vector3d> UnprojectRay(const Eigen::Vector2d& pixel) const;
  /// UnprojectRay from a first guess `near`, (x, y) of a ray known from neighbouring pixels.
  /// Several times faster if the guess is right to a small part of a pixel. The result differs by
  /// rounding, by up to 1e-13.
  std::optional<Eigen::Vector3d> UnprojectRay(const Eigen::Vector2d& pixel,
                                              const Eigen::Vector2d& near) const;

  /// Whether the pixel is inside the image, whose borders are at -0.5 and size - 0.5.
  bool Contains(const Eigen::Vector2d& pixel) const;

  /// The same camera with its image resampled by the factor s (0.5: half the resolution). The
  /// image borders stay where they are: u' + 0.5 = s (u + 0.5).
  CameraModel Scaled(double s) const;

  const CameraParameters& parameters() const { return parameters_; }
  int width_px() const { return parameters_.width_px; }
  int height_px() const { return parameters_.height_px; }
  /// [[fx, 0, cx], [0, fy, cy], [0, 0, 1]].
  Eigen::Matrix3d Matrix() const;
  bool has_distortion() const { return parameters_.distortion != BrownConrady{}; }
  double max_radius() const { return max_radius_; }

  bool operator==(const CameraModel& other) const { return parameters_ == other.parameters_; }

 private:
  CameraParameters parameters_;
  double max_radius_;
};

}  // namespace fenestra

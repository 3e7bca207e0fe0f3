#include "experiments/cramer_rao/picture_information.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "experiments/cramer_rao/border_profile.h"

namespace fenestra {
namespace {

constexpr int kSegments = 16;   // Per side.
constexpr int kMostLines = 64;  // Across a side.
constexpr double kMostMargin_px = 16.0;

// A point on an edge, in the picture.
struct Node {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, Eigen::Dynamic> by_unknowns;
};
using Nodes = std::vector<Node>;

std::optional<Node> NodeAt(const FrameState& frame, const ElectronPicture& view, FrameEdge edge,
                           const Eigen::Vector2d& place, int unknowns) {
  const FramePoint point = PointOn(frame, edge, place);
  const auto seen = view.camera.Linearise(view.X_VC * point.p_CQ);
  if (!seen || !view.camera.Contains(seen->pixel)) return std::nullopt;
  Node node{.pixel = seen->pixel, .by_unknowns = {}};
  node.by_unknowns.setZero(2, unknowns);
  const Eigen::Matrix3d& R_VC = view.X_VC.rotation();
  node.by_unknowns.leftCols<kFrameUnknowns>() = seen->by_point * (R_VC * point.by_frame);
  if (view.camera_unknown) {
    node.by_unknowns.middleCols<9>(*view.camera_unknown) = seen->by_parameters;
  }
  if (view.pose_unknown) {
    node.by_unknowns.middleCols<3>(*view.pose_unknown) =
        -seen->by_point * CrossMatrix(R_VC * point.p_CQ);
    node.by_unknowns.middleCols<3>(*view.pose_unknown + 3) = seen->by_point;
  }
  return node;
}

// Clockwise from the top, as seen from the front; t from -1 to 1 along the side.
Eigen::Vector2d PlaceOn(int side, double t) {
  const std::array<Eigen::Vector2d, kSides> places = {
      Eigen::Vector2d(t, 1.0), {1.0, -t}, {-t, -1.0}, {-1.0, t}};
  return places[static_cast<size_t>(side)];
}

std::optional<Nodes> NodesOf(const FrameState& frame, const ElectronPicture& view, FrameEdge edge,
                             int side, int unknowns) {
  Nodes nodes;
  for (int i = 0; i <= kSegments; ++i) {
    auto node = NodeAt(frame, view, edge, PlaceOn(side, 2.0 * i / kSegments - 1.0), unknowns);
    if (!node) return std::nullopt;
    nodes.push_back(std::move(*node));
  }
  return nodes;
}

// One side of the frame in one picture.
class Side {
 public:
  Side(const ElectronPicture& view, Nodes outer, Nodes inner, int level_unknown)
      : view_(view),
        outer_(std::move(outer)),
        inner_(std::move(inner)),
        level_unknown_(level_unknown) {
    const Eigen::Vector2d along = outer_.back().pixel - outer_.front().pixel;
    along_ = std::abs(along.x()) > std::abs(along.y()) ? 0 : 1;
    forward_ = along[along_] > 0.0;
    const Eigen::Vector2d inwards = inner_[kSegments / 2].pixel - outer_[kSegments / 2].pixel;
    const Eigen::Vector2d normal(-along.y(), along.x());
    turn_ = normal.dot(inwards) > 0.0 ? 1.0 : -1.0;
    border_px_ = std::abs(normal.normalized().dot(inwards));
  }

  Eigen::MatrixXd Information() const {
    const Eigen::Index unknowns = outer_.front().by_unknowns.cols();
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
    const double begin = outer_.front().pixel[along_];
    const double end = outer_.back().pixel[along_];
    const int lines = static_cast<int>(std::abs(end - begin));
    const int stride = std::max(1, (lines + kMostLines - 1) / kMostLines);
    for (int segment = 0; segment < kSegments; ++segment) {
      information += InformationOfSegment(segment, stride);
    }
    return information;
  }

 private:
  int across() const { return 1 - along_; }

  Eigen::Vector2d NormalOf(const Nodes& nodes, int segment) const {
    const auto i = static_cast<size_t>(segment);
    const Eigen::Vector2d along = (nodes[i + 1].pixel - nodes[i].pixel).normalized();
    return turn_ * Eigen::Vector2d(-along.y(), along.x());
  }

  // Where an edge crosses a line of pixels: the segment, and how far along it; nullopt beyond the
  // edge's ends.
  struct Place {
    int segment;
    double fraction;
  };
  std::optional<Place> PlaceOnLine(const Nodes& nodes, double line) const {
    for (int i = 0; i < kSegments; ++i) {
      const double from = nodes[static_cast<size_t>(i)].pixel[along_];
      const double to = nodes[static_cast<size_t>(i) + 1].pixel[along_];
      const double fraction = (line - from) / (to - from);
      if (fraction >= 0.0 && fraction <= 1.0) return Place{i, fraction};
    }
    return std::nullopt;
  }

  static Eigen::Vector2d PixelAt(const Nodes& nodes, const Place& place) {
    const auto i = static_cast<size_t>(place.segment);
    return (1.0 - place.fraction) * nodes[i].pixel + place.fraction * nodes[i + 1].pixel;
  }

  // By how much the edge moves inwards, by the unknowns.
  Eigen::RowVectorXd Motion(const Nodes& nodes, const Place& place) const {
    const auto i = static_cast<size_t>(place.segment);
    return NormalOf(nodes, place.segment).transpose() *
           ((1.0 - place.fraction) * nodes[i].by_unknowns +
            place.fraction * nodes[i + 1].by_unknowns);
  }

  double BlurAt(const Eigen::Vector2d& pixel) const {
    return std::sqrt(VarianceAt(view_.spread, view_.electrons.size(), pixel));
  }

  double ElectronsAt(const Eigen::Vector2d& pixel) const {
    const int u = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, view_.electrons.cols - 1);
    const int v = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, view_.electrons.rows - 1);
    return static_cast<double>(view_.electrons(v, u));
  }

  // How bright it is on both sides of the edges, averaged along a segment.
  BorderLevels LevelsOf(int segment, const BlurredEdge& outer, const BlurredEdge& inner) const {
    constexpr int kSamples = 4;
    const double beside_px = outer.reach_px() + 0.5;
    const Eigen::Vector2d inwards = NormalOf(outer_, segment);
    BorderLevels levels;
    double middle_e = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const Place place{segment, (i + 0.5) / kSamples};
      const Eigen::Vector2d at_outer = PixelAt(outer_, place);
      const Eigen::Vector2d at_inner = PixelAt(inner_, place);
      levels.wall_e += ElectronsAt(at_outer - beside_px * inwards) / kSamples;
      levels.opening_e += ElectronsAt(at_inner + beside_px * inwards) / kSamples;
      middle_e += ElectronsAt(0.5 * (at_outer + at_inner)) / kSamples;
    }
    // The middle of a narrow border still gets light from both sides.
    const double in = outer.At(0.5 * border_px_).share;
    const double on = inner.At(-0.5 * border_px_).share;
    const double own = std::max(0.2, in - on);
    levels.frame_e = (middle_e - levels.wall_e * (1.0 - in) - levels.opening_e * on) / own;
    levels.frame_e = std::max(0.0, levels.frame_e);
    return levels;
  }

  BorderInformation InformationOfLine(int line, const BlurredEdge& outer, const BlurredEdge& inner,
                                      const BorderLevels& levels) const {
    const auto outer_place = PlaceOnLine(outer_, line);
    if (!outer_place) return BorderInformation::Zero();
    const auto crossing = [&](const BlurredEdge& edge, const Nodes& nodes, const Place& place) {
      return EdgeCrossing{.edge = edge,
                          .place = PixelAt(nodes, place)[across()],
                          .slant = NormalOf(nodes, place.segment)[across()]};
    };
    const auto inner_place = PlaceOnLine(inner_, line);
    const int size = across() == 0 ? view_.electrons.cols : view_.electrons.rows;
    return InformationOf(
        {.outer = crossing(outer, outer_, *outer_place),
         .inner = inner_place ? std::optional(crossing(inner, inner_, *inner_place)) : std::nullopt,
         .margin_px = std::min(border_px_, kMostMargin_px),
         .first = 0,
         .last = size - 1},
        levels, view_.noise);
  }

  Eigen::MatrixXd InformationOfSegment(int segment, int stride) const {
    const Place middle{segment, 0.5};
    const Eigen::Vector2d centre = PixelAt(outer_, middle);
    const double blur_px = BlurAt(centre);
    const BlurredEdge outer(blur_px, NormalOf(outer_, segment));
    const BlurredEdge inner(blur_px, NormalOf(inner_, segment));
    const BorderLevels levels = LevelsOf(segment, outer, inner);
    double from = outer_[static_cast<size_t>(segment)].pixel[along_];
    double to = outer_[static_cast<size_t>(segment) + 1].pixel[along_];
    if (!forward_) std::swap(from, to);
    BorderInformation profile = BorderInformation::Zero();
    // Lines that are multiples of the stride, the same from segment to segment.
    for (int line = stride * static_cast<int>(std::ceil(from / stride)); line < to;
         line += stride) {
      profile += stride * InformationOfLine(line, outer, inner, levels);
    }
    const Eigen::Index unknowns = outer_.front().by_unknowns.cols();
    Eigen::MatrixXd by_unknowns = Eigen::MatrixXd::Zero(kBorderUnknowns, unknowns);
    by_unknowns.row(0) = Motion(outer_, middle);
    by_unknowns.row(1) = Motion(inner_, PlaceOnLine(inner_, centre[along_]).value_or(middle));
    by_unknowns(2, view_.blur_unknown) = 1.0;
    for (int i = 0; i < 3; ++i) by_unknowns(3 + i, level_unknown_ + i) = 1.0;
    return by_unknowns.transpose() * profile * by_unknowns;
  }

  const ElectronPicture& view_;
  Nodes outer_;
  Nodes inner_;
  int level_unknown_;
  int along_;  // The axis that the side goes along: 0 columns, 1 rows.
  bool forward_;
  double turn_;
  double border_px_;
};

}  // namespace

std::optional<Eigen::MatrixXd> PictureInformation(const FrameState& frame,
                                                  const ElectronPicture& view, int unknowns) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (int side = 0; side < kSides; ++side) {
    auto outer = NodesOf(frame, view, FrameEdge::kOuter, side, unknowns);
    auto inner = NodesOf(frame, view, FrameEdge::kInner, side, unknowns);
    if (!outer || !inner) return std::nullopt;
    information += Side(view, std::move(*outer), std::move(*inner), view.level_unknown + 3 * side)
                       .Information();
  }
  return information;
}

}  // namespace fenestra

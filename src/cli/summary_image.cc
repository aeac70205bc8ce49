#include "cli/summary_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/canvas.h"
#include "reprise/model/kinematics.h"

namespace reprise::cli {
namespace {

constexpr double figure_height = 200, least_cell_width = 60, thickness = 2.5;
constexpr long gap = 12, bar = 4, strip = 12, mark = 2;
/// From the front to the figure's right.
constexpr double viewed_from = std::numbers::pi / 5;
/// The furthest bone's shade; the nearest is black.
constexpr int furthest_shade = 20;

/// Of each joint: to the right, up and towards who looks, in mm.
using Figure = std::vector<Eigen::Vector3d>;

/// The turn about the vertical that brings the body's front towards who looks.
double turn_of(const PositionMatrix& places, const BodyMatch& match) {
  const int left = match.of(BodyJoint::hip_left), right = match.of(BodyJoint::hip_right);
  if (left < 0 || right < 0) return 0;
  const Eigen::Vector3d across = places.block<1, 3>(0, 3 * left) - places.block<1, 3>(0, 3 * right);
  return std::atan2(across.z(), across.x()) + viewed_from;
}

Figure figure_at(const Take& take, double seconds, const BodyMatch& match) {
  const long frame = std::clamp(std::lround(seconds * take.frame_rate), 0L, take.frames() - 1);
  PositionMatrix places = joint_positions(*take.skeleton, take.channels.middleRows(frame, 1));
  const Eigen::Matrix3d to_y = turn_to_y(take.skeleton->up);
  for (long j = 0; j < places.cols() / 3; ++j) {
    places.block<1, 3>(0, 3 * j) = (to_y * places.block<1, 3>(0, 3 * j).transpose()).transpose();
  }
  const Eigen::Matrix3d turn = axis_rotation(1, turn_of(places, match));
  Figure figure;
  for (long j = 0; j < places.cols() / 3; ++j) {
    figure.emplace_back(turn * places.block<1, 3>(0, 3 * j).transpose());
  }
  return figure;
}

/// Bones of the body: what hangs from a joint that only carries it through space is none.
bool is_bone(const Skeleton& skeleton, std::size_t joint) {
  const int parent = skeleton.joints[joint].parent;
  if (parent < 0) return false;
  const bool below_origin = skeleton.joints[static_cast<std::size_t>(parent)].parent < 0;
  return !(below_origin && skeleton.format == MotionFormat::bvh &&
           std::ranges::any_of(skeleton.joints[joint].channels, is_position));
}

/// What all figures have in common.
struct View {
  double scale = 1;                  ///< pixels a mm
  double ground = 0;                 ///< mm
  double nearest = 0, furthest = 0;  ///< mm, from the middle of a figure
  long cell_width = 0;
};

class Row {
 public:
  Row(const Skeleton& skeleton, std::vector<Figure> figures)
      : skeleton_(skeleton), figures_(std::move(figures)) {
    double top = 0, width = 0;
    bool first = true;
    for (Figure& figure : figures_) {
      centre(figure);
      for (std::size_t j = 0; j < figure.size(); ++j) {
        if (!is_bone(skeleton_, j)) continue;
        const Eigen::Vector3d& place = figure[j];
        view_.ground = first ? place.y() : std::min(view_.ground, place.y());
        top = first ? place.y() : std::max(top, place.y());
        first = false;
        width = std::max(width, std::abs(place.x()));
        view_.nearest = std::max(view_.nearest, place.z());
        view_.furthest = std::min(view_.furthest, place.z());
      }
    }
    // A lying figure is wider than it is high.
    view_.scale = figure_height / std::max({top - view_.ground, width, 1.0});
    view_.cell_width = std::lround(std::max(least_cell_width, 2 * width * view_.scale)) + gap;
  }

  long width() const { return view_.cell_width * static_cast<long>(figures_.size()) + gap; }
  long left_of(std::size_t figure) const {
    return gap + view_.cell_width * static_cast<long>(figure);
  }
  long cell_width() const { return view_.cell_width; }

  void draw(Canvas& canvas) const {
    for (std::size_t f = 0; f < figures_.size(); ++f) {
      const Figure& figure = figures_[f];
      for (const std::size_t j : far_bones_first(figure)) {
        const auto parent = static_cast<std::size_t>(skeleton_.joints[j].parent);
        canvas.line(pixel(f, figure[parent]), pixel(f, figure[j]), thickness, shade(figure[j].z()));
      }
    }
  }

 private:
  void centre(Figure& figure) const {
    Eigen::Vector3d low, high;
    bool first = true;
    for (std::size_t j = 0; j < figure.size(); ++j) {
      if (!is_bone(skeleton_, j)) continue;
      low = first ? figure[j] : low.cwiseMin(figure[j]).eval();
      high = first ? figure[j] : high.cwiseMax(figure[j]).eval();
      first = false;
    }
    if (first) return;
    const Eigen::Vector3d middle = (low + high) / 2;
    for (Eigen::Vector3d& place : figure) place -= Eigen::Vector3d(middle.x(), 0, middle.z());
  }

  std::vector<std::size_t> far_bones_first(const Figure& figure) const {
    std::vector<std::size_t> bones;
    for (std::size_t j = 0; j < figure.size(); ++j) {
      if (is_bone(skeleton_, j)) bones.push_back(j);
    }
    std::ranges::stable_sort(bones, {}, [&](std::size_t j) { return figure[j].z(); });
    return bones;
  }

  CanvasPoint pixel(std::size_t figure, const Eigen::Vector3d& place) const {
    const double middle = static_cast<double>(left_of(figure) + (view_.cell_width - gap) / 2);
    return {middle + place.x() * view_.scale,
            gap + figure_height - (place.y() - view_.ground) * view_.scale};
  }

  int shade(double towards) const {
    const double depth = view_.nearest - view_.furthest;
    const double part = depth > 0 ? (view_.nearest - towards) / depth : 0;
    return static_cast<int>(std::lround(part * furthest_shade));
  }

  const Skeleton& skeleton_;
  std::vector<Figure> figures_;
  View view_;
};

}  // namespace

std::string png_of(const Take& take, const std::vector<KeyPose>& poses, const JointMap& map) {
  const BodyMatch match = match_body(*take.skeleton, map);
  std::vector<Figure> figures;
  for (const KeyPose& pose : poses) figures.push_back(figure_at(take, pose.time, match));
  const Row row(*take.skeleton, std::move(figures));
  const long bars_at = static_cast<long>(figure_height) + 2 * gap, strip_at = bars_at + bar + gap;
  Canvas canvas(row.width(), strip_at + strip + gap);
  row.draw(canvas);
  const double pixels_per_second =
      static_cast<double>(row.width() - 2 * gap) / std::max(take.seconds(), 1e-9);
  const auto column = [&](double seconds) {
    return gap + std::lround(seconds * pixels_per_second);
  };
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const int colour = ink::behaviour + static_cast<int>(p) % ink::behaviours;
    canvas.fill(row.left_of(p), row.left_of(p) + row.cell_width() - gap, bars_at, bars_at + bar,
                colour);
    canvas.fill(column(poses[p].start), column(poses[p].end), strip_at, strip_at + strip, colour);
    canvas.fill(column(poses[p].time), column(poses[p].time) + mark, strip_at, strip_at + strip,
                ink::black);
  }
  return canvas.png();
}

}  // namespace reprise::cli

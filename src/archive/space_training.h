// A coefficient space from takes of one skeleton.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "archive/take_fit.h"
#include "ingest/principal_components.h"

namespace reprise {

struct TrainingConstants {
  /// Skeletons with more joints than this go without markers: axes of what moves with them take
  /// time with the cube of their number, and no body has so many.
  static constexpr std::size_t most_joints = 300;
  /// What the axes may leave of the allowed mean error (part of it, root mean square).
  static constexpr double residual_share = 0.32;
  /// What rounding the axes may add, as a part of it: `axis_share` between these two. Takes that
  /// come later have to live with it, so it stays small beside what is left for their curves.
  static constexpr double least_axis_share = 0.06;
  static constexpr double most_axis_share = 0.3;
  /// And rounding the mean.
  static constexpr double mean_share = 0.1;
  /// Frames are taken this many times a second.
  static constexpr double frames_a_second = 15.0;
  static constexpr long least_frames = 8;  ///< of a take, where it has so many
  /// A channel changes if it moves by more than this (degrees, or units of the file).
  static constexpr double least_change = 1e-3;
};

/// Which values channels have where they do not move.
class ConstantValues {
 public:
  /// Those of a take: its constants, and its first frame where that is apart.
  void add(const TakeHeader& header);
  void add(const ConstantValues& other);
  /// Values that several takes have.
  KnownValues known_values(std::size_t channels) const;

 private:
  std::vector<std::pair<std::size_t, double>> values_;  ///< of a channel, one for each take
};

/// What takes say about the layout. Takes are added up in a fixed order.
struct LayoutEvidence {
  std::vector<bool> active;
  std::vector<double> travel;  ///< of each joint: range of its position channels, mm
  /// Of each joint: sum of its orientations, in a world that is turned to Y with the joint's axes.
  std::vector<Eigen::Matrix3d> orientations;
  std::vector<std::vector<double>> first_frames;  ///< of each take that has frames
  ConstantValues values;

  void add(const LayoutEvidence& other);
  /// What the take would have said had it been read with another unit and up axis than `skeleton`
  /// has.
  void read_as(const Skeleton& skeleton, double millimetres_per_unit, UpAxis up);
};
LayoutEvidence layout_evidence(const PreparedTake& prepared);
LayoutChoices choose_layout(const Skeleton& skeleton, const LayoutEvidence& evidence);

/// Every n-th frame of a take as markers.
MarkerMatrix sampled_markers(const MarkerLayout& layout, const Take& take);

/// Axes for a mean error of `mean_mm`, not yet rounded. `start` is the median of each channel over
/// first frames: what most takes begin in the branch of.
CoefficientSpace train_space(MarkerLayout layout, const MarkerMoments& moments,
                             const LayoutEvidence& evidence, double mean_mm);
/// `base` with further axes for what does not fit it.
CoefficientSpace extend_space(const CoefficientSpace& base, const MarkerMoments& moments,
                              double mean_mm);

/// The part of the allowed mean error at which axes of so many `entries`, and curves of takes that
/// take some `curve_bits`, are smallest together: an entry takes a bit less for each doubling, and
/// curves grow with about the power -0.7 of the squared error that is left for them
/// (docs/findings/2026-11-26-axes.md).
double axis_share(double entries, double curve_bits);

/// What mean and axes are rounded to, the latter by `share`.
SpacePrecision space_precision(const CoefficientSpace& space, double mean_mm, double share);

}  // namespace reprise

// Postures of a take at a reduced rate, with heading and ground place taken out: what repeated
// motion is looked for in.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "reprise/model/take.h"

namespace reprise {

/// samples x 3*joints, row-major, mm: x, y, z of the root joint and all joints and end sites below
/// it, relative to the ground under the root joint and turned so that it faces one way. Heights
/// stay.
using PostureMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The joint that carries a motion through space, and its axis that points up (LayoutChoices).
struct RootAxis {
  int joint = 0;
  int up_axis = 1;
};

/// Postures at `rate` samples a second: sample s is at s / rate seconds, between two frames by
/// linear interpolation. A take without frames has no samples.
PostureMatrix aligned_postures(const Take& take, const RootAxis& root, double rate);

/// The length of all bones under the root joint together (mm), in the first frame; 0 where there
/// are none.
double body_size(const Take& take, const RootAxis& root);

/// What to multiply the postures of bodies with to bring each to the median size. 1 for sizes that
/// are not positive.
std::vector<float> factors_to_median_size(std::span<const double> sizes);
/// Brings the postures of each take to the median size; returns by which factors.
std::vector<float> bring_to_median_size(std::span<PostureMatrix> takes,
                                        std::span<const double> sizes);

/// The leading axes of many postures. A distance of two projected postures is close to the root
/// mean square distance of their joints in mm, and never larger.
class PostureBasis {
 public:
  /// At most `axes` of them. `takes` share a skeleton; they may be empty.
  PostureBasis(std::span<const PostureMatrix> takes, int axes);

  /// samples x axes.
  PostureMatrix project(const PostureMatrix& postures) const;

 private:
  Eigen::RowVectorXf mean_;
  Eigen::MatrixXf axes_;  ///< 3*joints x axes, divided by the root of the number of joints
};

/// Mean distance (mm) of the joints of two postures.
float mean_joint_distance(const float* a, const float* b, Eigen::Index coordinates);

}  // namespace reprise

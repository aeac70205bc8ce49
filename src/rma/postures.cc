#include "rma/postures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "ingest/root_alignment.h"
#include "model/symmetric_eigen.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

/// Axes of postures take time with the cube of this.
constexpr std::size_t most_posture_joints = 300;

/// The root joint and all below it: others do not go where it goes.
std::vector<std::size_t> joints_under(const Skeleton& skeleton, int root) {
  std::vector<bool> under(skeleton.joints.size(), false);
  std::vector<std::size_t> list;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    under[j] =
        static_cast<int>(j) == root || (parent >= 0 && under[static_cast<std::size_t>(parent)]);
    if (under[j]) list.push_back(j);
  }
  return list;
}

/// Of very many joints some, spread evenly, say how a body stands.
std::vector<std::size_t> some_of(const std::vector<std::size_t>& joints) {
  if (joints.size() <= most_posture_joints) return joints;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most_posture_joints; ++i) {
    some.push_back(joints[i * joints.size() / most_posture_joints]);
  }
  return some;
}

/// Joint places of one frame, seen from the ground below the root joint.
Eigen::RowVectorXf posture_of_frame(const Take& take, const RootAxis& root,
                                    const Eigen::Matrix3d& from_home, long frame,
                                    const std::vector<std::size_t>& moving,
                                    std::vector<JointFrame>& joints) {
  const Skeleton& skeleton = *take.skeleton;
  forward_kinematics(
      skeleton, {take.channels.row(frame).data(), static_cast<std::size_t>(skeleton.channel_count)},
      joints);
  const JointFrame& root_frame = joints[static_cast<std::size_t>(root.joint)];
  const Eigen::Matrix3d to_y = turn_to_y(skeleton.up);
  const Eigen::Matrix3d unturned =
      axis_rotation(1, -heading_of(to_y * root_frame.rotation * from_home));
  const Eigen::Vector3d place = to_y * root_frame.position;
  const Eigen::Vector3d ground(place.x(), 0, place.z());
  Eigen::RowVectorXf posture(3 * static_cast<Eigen::Index>(moving.size()));
  for (std::size_t j = 0; j < moving.size(); ++j) {
    posture.segment<3>(3 * static_cast<Eigen::Index>(j)) =
        (unturned * (to_y * joints[moving[j]].position - ground)).transpose().cast<float>();
  }
  return posture;
}

}  // namespace

PostureMatrix aligned_postures(const Take& take, const RootAxis& root, double rate) {
  constexpr double rounding = 1e-6;
  const long frames = take.frames();
  const std::vector<std::size_t> moving = some_of(joints_under(*take.skeleton, root.joint));
  const auto coordinates = 3 * static_cast<Eigen::Index>(moving.size());
  if (frames == 0) return PostureMatrix(0, coordinates);
  const double step = take.frame_rate / rate;
  const auto samples =
      static_cast<Eigen::Index>(std::floor(static_cast<double>(frames - 1) / step + rounding)) + 1;
  const Eigen::Matrix3d from_home = from_home_orientation(root.up_axis, take.skeleton->up);
  std::vector<JointFrame> joints(take.skeleton->joints.size());
  PostureMatrix postures(samples, coordinates);
  for (Eigen::Index s = 0; s < samples; ++s) {
    const double at = std::min(static_cast<double>(s) * step, static_cast<double>(frames - 1));
    const long frame = static_cast<long>(std::floor(at + rounding));
    const auto part = static_cast<float>(at - static_cast<double>(frame));
    postures.row(s) = posture_of_frame(take, root, from_home, frame, moving, joints);
    if (part > rounding && frame + 1 < frames) {
      postures.row(s) +=
          part *
          (posture_of_frame(take, root, from_home, frame + 1, moving, joints) - postures.row(s));
    }
  }
  return postures;
}

double body_size(const Take& take, const RootAxis& root) {
  if (take.frames() == 0) return 0;
  const Skeleton& skeleton = *take.skeleton;
  std::vector<JointFrame> joints(skeleton.joints.size());
  forward_kinematics(
      skeleton, {take.channels.row(0).data(), static_cast<std::size_t>(skeleton.channel_count)},
      joints);
  double size = 0;
  for (const std::size_t joint : joints_under(skeleton, root.joint)) {
    if (static_cast<int>(joint) == root.joint) continue;
    const auto parent = static_cast<std::size_t>(skeleton.joints[joint].parent);
    size += (joints[joint].position - joints[parent].position).norm();
  }
  return size;
}

std::vector<float> factors_to_median_size(std::span<const double> sizes) {
  std::vector<float> factors(sizes.size(), 1.0F);
  const auto is_known = [](double size) { return std::isfinite(size) && size > 0; };
  std::vector<double> known;
  std::ranges::copy_if(sizes, std::back_inserter(known), is_known);
  if (known.empty()) return factors;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::ranges::nth_element(known, middle);
  for (std::size_t take = 0; take < sizes.size(); ++take) {
    if (is_known(sizes[take])) factors[take] = static_cast<float>(*middle / sizes[take]);
  }
  return factors;
}

std::vector<float> bring_to_median_size(std::span<PostureMatrix> takes,
                                        std::span<const double> sizes) {
  std::vector<float> factors = factors_to_median_size(sizes);
  for (std::size_t take = 0; take < takes.size(); ++take) takes[take] *= factors[take];
  return factors;
}

PostureBasis::PostureBasis(std::span<const PostureMatrix> takes, int axes) {
  Eigen::Index coordinates = 0, samples = 0;
  for (const PostureMatrix& take : takes) {
    coordinates = take.cols();
    samples += take.rows();
  }
  if (samples == 0 || coordinates == 0) return;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(coordinates);
  for (const PostureMatrix& take : takes) sum += take.cast<double>().colwise().sum();
  mean_ = (sum / static_cast<double>(samples)).cast<float>();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(coordinates, coordinates);
  for (const PostureMatrix& take : takes) {
    const Eigen::MatrixXf centred = take.rowwise() - mean_;
    products.noalias() += (centred.transpose() * centred).cast<double>();
  }
  const SymmetricEigen solved = symmetric_eigen(products);
  const Eigen::Index kept = std::min<Eigen::Index>(axes, coordinates);
  const double joints = static_cast<double>(coordinates) / 3;
  axes_ = (solved.vectors.rightCols(kept).rowwise().reverse() / std::sqrt(joints)).cast<float>();
}

PostureMatrix PostureBasis::project(const PostureMatrix& postures) const {
  if (postures.rows() == 0 || axes_.size() == 0)
    return PostureMatrix(postures.rows(), axes_.cols());
  return (postures.rowwise() - mean_) * axes_;
}

float mean_joint_distance(const float* a, const float* b, Eigen::Index coordinates) {
  float sum = 0;
  for (Eigen::Index c = 0; c < coordinates; c += 3) {
    const float x = a[c] - b[c], y = a[c + 1] - b[c + 1], z = a[c + 2] - b[c + 2];
    sum += std::sqrt(x * x + y * y + z * z);
  }
  return 3 * sum / static_cast<float>(coordinates);
}

}  // namespace reprise

#include "query/likeness.h"

#include <algorithm>
#include <cmath>

#include "query/time_warp.h"

namespace reprise {
namespace {

using K = LikenessConstants;

constexpr int direction_size = plan_bones * 3;

/// Directions and speeds of a track at a time between two frames.
void interpolate(const PostureTrack& track, double seconds, float* directions, float* speeds) {
  const double place =
      std::clamp(seconds * PostureConstants::rate, 0.0, static_cast<double>(track.frames() - 1));
  const long frame = std::min(static_cast<long>(place), std::max(0L, track.frames() - 2));
  const long next = std::min(frame + 1, track.frames() - 1);
  const float part = static_cast<float>(place - static_cast<double>(frame));
  const auto mix = [&](const auto* values, int size, float* out) {
    const auto* a = values + frame * size;
    const auto* b = values + next * size;
    for (int i = 0; i < size; ++i) {
      out[i] = static_cast<float>(a[i]) * (1.0f - part) + static_cast<float>(b[i]) * part;
    }
  };
  mix(track.directions.data(), direction_size, directions);
  mix(track.speeds.data(), root_speeds, speeds);
}

/// Path of each bone end over the stretch, mm, from frame to frame.
BoneValues paths(const BodyPostures& rows) {
  BoneValues sum = BoneValues::Zero();
  for (long f = 1; f < rows.rows(); ++f) {
    for (int b = 0; b < plan_bones; ++b) {
      sum[b] += (rows.row(f).segment<3>(3 * b) - rows.row(f - 1).segment<3>(3 * b)).norm();
    }
  }
  return sum;
}

/// Standard deviation of the place of each bone end.
BoneValues deviations(const BodyPostures& rows) {
  const PostureRow mean = rows.colwise().mean();
  BoneValues squares = BoneValues::Zero();
  for (long f = 0; f < rows.rows(); ++f) {
    for (int b = 0; b < plan_bones; ++b) {
      squares[b] += (rows.row(f) - mean).segment<3>(3 * b).squaredNorm();
    }
  }
  return (squares / static_cast<float>(rows.rows())).sqrt();
}

/// Weight of each bone end by how much it moves; their mean is 1.
BoneValues activity_weights(const BoneValues& activity) {
  const BoneValues weights = activity.pow(K::activity_power);
  const float mean = weights.mean();
  return mean > 0 ? BoneValues(weights / mean) : BoneValues::Ones();
}

MotionSummary summary_of(const MotionForm& form) {
  MotionSummary summary;
  summary.mean = form.rows.colwise().mean();
  summary.deviation =
      ((form.rows.rowwise() - summary.mean).array().square().colwise().mean()).sqrt();
  // Bone ends that hardly move say nothing.
  const float most = std::max(form.activity.maxCoeff(), 1.0f);
  summary.restlessness = form.recurrence * (form.activity / most).sqrt();
  summary.length = static_cast<float>(std::log(form.seconds));
  return summary;
}

/// What the numbers of a mean count in a summary.
PostureRow mean_scale(const LikenessWeights& weights) {
  PostureRow scale = PostureRow::Ones();
  scale.tail<root_speeds>() << weights.summary_speed, weights.summary_speed, weights.summary_turn;
  return scale;
}

/// What the numbers of a deviation count.
PostureRow deviation_scale(const LikenessWeights& weights) {
  PostureRow scale = PostureRow::Ones();
  scale.tail<root_speeds>().setConstant(weights.summary_unsteadiness);
  return scale;
}

/// Distance of two summaries; of `shared` bones alone.
double summary_distance(const MotionSummary& a, const MotionSummary& b, const BoneValues& shared,
                        const LikenessWeights& weights) {
  PostureRow counted = PostureRow::Ones();
  for (int i = 0; i < plan_bones; ++i) counted.segment<3>(3 * i).setConstant(shared[i]);
  const auto squares = [&](const PostureRow& row_a, const PostureRow& row_b,
                           const PostureRow& scale) {
    return double{(((row_a - row_b).array() * scale.array()).square() * counted.array()).sum()};
  };
  const double recurrence =
      double{(shared * (a.restlessness - b.restlessness).square()).sum()} / plan_bones;
  const double duration = double{a.length - b.length} * weights.summary_duration;
  return std::sqrt(squares(a.mean, b.mean, mean_scale(weights)) +
                   squares(a.deviation, b.deviation, deviation_scale(weights)) +
                   recurrence * weights.summary_recurrence * weights.summary_recurrence +
                   duration * duration);
}

const float per_bone = std::sqrt(1.0f / static_cast<float>(plan_bones));

}  // namespace

BodyPostures postures(const PostureTrack& track, const Stretch& stretch, int count, float bearing) {
  BodyPostures rows(count, posture_size);
  std::array<float, direction_size> directions{}, ends{};
  std::array<float, root_speeds> speeds{};
  for (int i = 0; i < count; ++i) {
    const double part = count > 1 ? static_cast<double>(i) / (count - 1) : 0.5;
    interpolate(track, stretch.begin + part * stretch.seconds(), directions.data(), speeds.data());
    for (std::size_t k = 0; k < directions.size(); ++k) {
      directions[k] = (directions[k] - bearing * static_cast<float>(track.median[k])) /
                      PostureConstants::direction_unit;
    }
    bone_ends(track.plan, directions.data(), ends.data());
    for (int k = 0; k < direction_size; ++k) {
      rows(i, k) = ends[static_cast<std::size_t>(k)] * per_bone;
    }
    for (int k = 0; k < root_speeds; ++k) {
      rows(i, direction_size + k) = K::speed_weight * speeds[static_cast<std::size_t>(k)];
    }
  }
  return rows;
}

Eigen::Matrix<float, 1, MotionSummary::numbers> MotionSummary::row(
    const LikenessWeights& weights) const {
  Eigen::Matrix<float, 1, numbers> row;
  row << mean.cwiseProduct(mean_scale(weights)), deviation.cwiseProduct(deviation_scale(weights)),
      restlessness.matrix().transpose() *
          (weights.summary_recurrence / std::sqrt(static_cast<float>(plan_bones))),
      weights.summary_duration * length;
  return row;
}

int samples_for(double seconds) {
  return std::clamp(static_cast<int>(std::ceil(seconds / K::longest_step)), K::samples,
                    K::most_samples);
}

MotionForm motion_form(const PostureTrack& track, const Stretch& stretch, int samples) {
  MotionForm form;
  form.rows = postures(track, stretch, samples, K::bearing_taken_out);
  form.activity = deviations(form.rows) / per_bone;
  const int frames =
      std::max(2, static_cast<int>(std::lround(stretch.seconds() * PostureConstants::rate)) + 1);
  const BodyPostures all = postures(track, stretch, frames, 0.0f);
  form.recurrence =
      ((paths(all) / per_bone + K::rest_mm) / (deviations(all) / per_bone + K::rest_mm)).log();
  for (int b = 0; b < plan_bones; ++b) {
    form.lengths[b] = track.plan.lengths[static_cast<std::size_t>(b)];
  }
  form.seconds = std::max(stretch.seconds(), 1.0 / PostureConstants::rate);
  form.summary = summary_of(form);
  return form;
}

double unlikeness(const MotionForm& a, const MotionForm& b, const LikenessWeights& weights) {
  // What one of the bodies does not have is not compared.
  const BoneValues shared = (a.lengths > 0 && b.lengths > 0).cast<float>();
  const BoneValues active =
      shared * (activity_weights(a.activity) + activity_weights(b.activity)) / 2;
  PostureRow scale = PostureRow::Ones();
  for (int i = 0; i < plan_bones; ++i) scale.segment<3>(3 * i).setConstant(std::sqrt(active[i]));
  const CostMatrix scaled_a = a.rows.array().rowwise() * scale.array();
  const CostMatrix scaled_b = b.rows.array().rowwise() * scale.array();
  const double posture = warped_cost(row_distances(scaled_a, scaled_b));

  const auto share = [&](const BoneValues& activity) -> BoneValues {
    const float sum = (shared * activity).sum();
    return sum > 0 ? BoneValues(shared * activity / sum) : BoneValues(shared / plan_bones);
  };
  const BoneValues shares = (share(a.activity) + share(b.activity)) / 2;
  const double recurrence = double{(shares * (a.recurrence - b.recurrence).square()).sum()} *
                            weights.course_recurrence * weights.course_recurrence;
  const double duration = std::log(a.seconds / b.seconds) * weights.course_duration;
  const double course = std::sqrt(posture * posture + recurrence + duration * duration);
  return (1 - weights.summary_part) * course +
         weights.summary_part * summary_distance(a.summary, b.summary, shared, weights);
}

double mean_joint_distance(const PostureTrack& a, const Stretch& in_a, const PostureTrack& b,
                           const Stretch& in_b) {
  const int samples = samples_for(std::max(in_a.seconds(), in_b.seconds()));
  const BodyPostures rows_a = postures(a, in_a, samples, 0.0f);
  const BodyPostures rows_b = postures(b, in_b, samples, 0.0f);
  std::vector<int> shared;
  for (int i = 0; i < plan_bones; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (a.plan.lengths[at] > 0 && b.plan.lengths[at] > 0) shared.push_back(i);
  }
  if (shared.empty()) return 0;
  double sum = 0;
  const auto path = warping_path(
      row_distances(rows_a.leftCols<direction_size>(), rows_b.leftCols<direction_size>()));
  for (const auto& [i, j] : path) {
    for (const int k : shared) {
      sum += (rows_a.row(i).segment<3>(3 * k) - rows_b.row(j).segment<3>(3 * k)).norm();
    }
  }
  return sum / (per_bone * static_cast<double>(shared.size() * path.size()));
}

}  // namespace reprise

#include "query/take_ranking.h"

#include <algorithm>
#include <cmath>

namespace reprise {

TakeRanking::Description TakeRanking::describe(const PostureTrack& track) {
  using K = LikenessConstants;
  const Stretch whole{0, static_cast<double>(track.frames() - 1) / PostureConstants::rate};
  const MotionForm form = motion_form(track, whole, K::samples);
  const Eigen::Matrix<float, 1, posture_size> mean = form.rows.colwise().mean();
  Description description;
  description.segment<posture_size>(0) = mean;
  description.segment<posture_size>(posture_size) =
      ((form.rows.rowwise() - mean).array().square().colwise().mean()).sqrt();
  // Bone ends that hardly move say nothing.
  const float most = std::max(form.activity.maxCoeff(), 1.0f);
  description.segment<plan_bones>(2 * posture_size) =
      (form.recurrence * (form.activity / most).sqrt()).matrix().transpose() *
      (K::recurrence_weight / std::sqrt(static_cast<float>(plan_bones)));
  description[numbers - 1] = K::duration_weight * static_cast<float>(std::log(form.seconds));
  return description;
}

TakeRanking::TakeRanking(const std::vector<const PostureTrack*>& tracks) {
  descriptions_.resize(static_cast<long>(tracks.size()), numbers);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    descriptions_.row(static_cast<long>(i)) = describe(*tracks[i]);
  }
}

std::vector<std::size_t> TakeRanking::nearest(const PostureTrack& query, std::size_t count,
                                              const std::vector<bool>& accept) const {
  const Description wanted = describe(query);
  std::vector<std::pair<float, std::size_t>> distances;
  for (std::size_t i = 0; i < accept.size(); ++i) {
    if (!accept[i]) continue;
    distances.emplace_back((descriptions_.row(static_cast<long>(i)) - wanted).squaredNorm(), i);
  }
  const std::size_t kept = std::min(count, distances.size());
  std::partial_sort(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(kept),
                    distances.end());
  std::vector<std::size_t> nearest;
  for (std::size_t i = 0; i < kept; ++i) nearest.push_back(distances[i].second);
  return nearest;
}

}  // namespace reprise

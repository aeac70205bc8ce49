#include "query/take_ranking.h"

#include <algorithm>

namespace reprise {

TakeRanking::Description TakeRanking::describe(const PostureTrack& track) {
  const Stretch whole{0, static_cast<double>(track.frames() - 1) / PostureConstants::rate};
  return motion_form(track, whole, LikenessConstants::samples).summary.row(take_weights);
}

TakeRanking::TakeRanking(const std::vector<const PostureTrack*>& tracks) {
  descriptions_.resize(static_cast<long>(tracks.size()), MotionSummary::numbers);
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

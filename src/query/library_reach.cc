#include "query/library_reach.h"

#include <algorithm>
#include <cmath>

#include "query/time_warp.h"
#include "rma/group_members.h"
#include "rma/posture_reach.h"

namespace reprise {

LibraryReach::LibraryReach(const std::vector<const PostureTrack*>& tracks) {
  constexpr long least = 1000;
  long total = 0;
  for (const PostureTrack* track : tracks) total += track->frames();
  const long stride = std::max(1L, total / least);
  sample_.resize((total + stride - 1) / stride, posture_size);
  long next = 0, before = 0;  // counted over all tracks
  for (const PostureTrack* track : tracks) {
    for (; next < before + track->frames(); next += stride) {
      const double at = static_cast<double>(next - before) / PostureConstants::rate;
      sample_.row(next / stride) = postures(*track, {at, at}, 1, 0.0f);
    }
    before += track->frames();
  }
}

double LibraryReach::repeat_limit(const PostureTrack& track, const Stretch& stretch) const {
  const RepeatConstants constants;
  const BodyPostures rows = postures(track, stretch, samples_for(stretch.seconds()), 0.0f);
  constexpr int places = 3 * plan_bones;  // speeds do not enter
  CostMatrix distances = row_distances(rows.leftCols<places>(), sample_.leftCols<places>());
  const auto rank = static_cast<long>(constants.reach_part * static_cast<double>(sample_.rows()));
  const auto bones = std::ranges::count_if(track.plan.lengths, [](auto l) { return l > 0; });
  if (sample_.rows() == 0 || bones == 0) return 0;
  // What a body does not have counts in no distance.
  const float of_bones = std::sqrt(static_cast<float>(plan_bones) / static_cast<float>(bones));
  float similar = 0;
  for (long row = 0; row < distances.rows(); ++row) {
    float* const first = distances.row(row).data();
    const long place = std::min(rank, distances.cols() - 1);
    std::nth_element(first, first + place, first + distances.cols());
    similar += similar_at_reach(of_bones * first[place], constants);
  }
  similar /= static_cast<float>(distances.rows());
  const float usual = constants.member_mm * similar / constants.similar_mm;
  return double{asked_limit(usual, constants.member_mm, constants)};
}

double motion_size(const PostureTrack& track, const Stretch& stretch) {
  const BodyPostures rows = postures(track, stretch, samples_for(stretch.seconds()), 0.0f);
  const PostureRow mean = rows.colwise().mean();
  double sum = 0;
  int bones = 0;
  for (int k = 0; k < plan_bones; ++k) {
    if (!(track.plan.lengths[static_cast<std::size_t>(k)] > 0)) continue;
    ++bones;
    for (long row = 0; row < rows.rows(); ++row) {
      sum += double{(rows.row(row) - mean).segment<3>(3 * k).norm()};
    }
  }
  if (bones == 0) return 0;
  return sum * std::sqrt(static_cast<double>(plan_bones)) /
         static_cast<double>(bones * rows.rows());
}

}  // namespace reprise

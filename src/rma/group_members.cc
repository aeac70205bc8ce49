#include "rma/group_members.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "rma/clip_alignment.h"
#include "rma/parallel_for.h"

namespace reprise {
namespace {

/// RepeatConstants::member_mm in proportion to what is similar to the clip's postures in a take.
float member_limit(const PostureLibrary& library, const Occurrence& clip, std::size_t take,
                   const RepeatConstants& constants) {
  const auto similar = library.similar(clip.take, take).begin();
  const float sum = std::accumulate(similar + clip.begin, similar + clip.end, 0.0F);
  const float mean = sum / static_cast<float>(clip.end - clip.begin);
  return constants.member_mm * mean / constants.similar_mm;
}

/// The part of it that counts for a clip of this many samples.
float length_share(long samples, const RepeatConstants& constants) {
  const double shortest = constants.least_path_s,
               seconds = static_cast<double>(samples) / constants.rate;
  const double part =
      std::clamp((seconds - shortest) / (constants.whole_clip_s - shortest), 0.0, 1.0);
  return constants.short_share + (1 - constants.short_share) * static_cast<float>(part);
}

/// What is like the clip in a part and does not overlap it.
std::vector<Occurrence> members_in(const PostureLibrary& library, const Occurrence& clip,
                                   const PostureView& view, const SearchedPart& part,
                                   const MemberLimit& most_mm, const RepeatConstants& constants) {
  const auto found =
      align_clip(view, library.view(part.take, part.begin, part.end), most_mm(part.take));
  const long least = std::lround(constants.least_clip_s * constants.rate);
  std::vector<Occurrence> members;
  for (const AlignedClip& member : found) {
    const long begin = part.begin + member.begin, end = part.begin + member.end;
    if (end - begin < least) continue;
    if (part.take == clip.take && begin < clip.end && clip.begin < end) continue;
    Occurrence occurrence{part.take, begin, end, member.mean_mm, member.map};
    for (long& sample : occurrence.map) sample += part.begin;
    members.push_back(std::move(occurrence));
  }
  return members;
}

}  // namespace

bool moves(const PostureView& clip, const RepeatConstants& constants) {
  const long steps = clip.postures.rows() - 1;
  double sum = 0;
  for (long s = 0; s < steps; ++s) {
    sum += mean_joint_distance(clip.postures.row(s).data(), clip.postures.row(s + 1).data(),
                               clip.postures.cols());
  }
  return steps > 0 &&
         sum / static_cast<double>(steps) * constants.rate >= constants.least_speed_mm_s;
}

MemberLimit group_limit(const PostureLibrary& library, const Occurrence& clip,
                        const RepeatConstants& constants) {
  const float share = length_share(clip.end - clip.begin, constants);
  return
      [&, share](std::size_t take) { return share * member_limit(library, clip, take, constants); };
}

float asked_limit(float usual, float widest, const RepeatConstants& constants) {
  return std::max(usual, std::min(widest, constants.asked_share * usual));
}

MemberLimit asked_limit(const PostureLibrary& library, const Occurrence& clip,
                        const RepeatConstants& constants) {
  return [&](std::size_t take) {
    const float widest = library.of_one_subject(clip.take, take)
                             ? constants.member_mm
                             : constants.across_subjects * constants.member_mm;
    return asked_limit(member_limit(library, clip, take, constants), widest, constants);
  };
}

std::vector<Occurrence> find_members(const PostureLibrary& library, const Occurrence& clip,
                                     const std::vector<SearchedPart>& parts,
                                     const MemberLimit& most_mm, const RepeatConstants& constants,
                                     unsigned jobs) {
  // A thread costs as much as some alignments.
  constexpr std::size_t least_parts = 16;
  const PostureView view = library.view(clip.take, clip.begin, clip.end);
  std::vector<std::vector<Occurrence>> found(parts.size());
  parallel_for(parts.size(), parts.size() < least_parts ? 1 : jobs, [&](std::size_t s) {
    found[s] = members_in(library, clip, view, parts[s], most_mm, constants);
  });
  std::vector<Occurrence> members;
  for (auto& list : found) std::ranges::move(list, std::back_inserter(members));
  return members;
}

}  // namespace reprise

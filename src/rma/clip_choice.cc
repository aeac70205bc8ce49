#include "rma/clip_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include "rma/clip_completion.h"
#include "rma/clip_costs.h"
#include "rma/clip_cover.h"

namespace reprise {
namespace {

/// A primary and its repeats as they would be now.
struct Proposal {
  double gain = 0;
  ChosenClip primary;
  std::optional<std::size_t> standing;  ///< index of the primary, if it stands already
  std::vector<ChosenClip> repeated;
};

class Chooser {
 public:
  Chooser(const PostureLibrary& library, const RepeatConstants& constants,
          const ClipChoiceConstants& choice, std::span<const ChosenClip> standing)
      : library_(library),
        least_(std::max(2L, std::lround(choice.least_s * constants.rate))),
        least_repeated_(std::max(2L, std::lround(choice.least_repeated_s * constants.rate))),
        least_primary_(std::max(2L, std::lround(choice.least_primary_s * constants.rate))),
        stored_(standing.size()) {
    for (const PostureMatrix& take : library.postures) {
      free_.emplace_back(static_cast<std::size_t>(take.rows()), true);
    }
    for (const ChosenClip& clip : standing) {
      if (clip.role != ClipRole::repeated)
        standing_[std::tuple(clip.take, clip.begin, clip.end)] = clips_.size();
      occupy(clip);
      clips_.push_back(clip);
    }
  }

  void choose(std::span<const RepeatGroup> groups) {
    using Rank = std::pair<double, std::size_t>;  // gain; of equal ones the earlier group
    const auto lower = [](const Rank& a, const Rank& b) {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    };
    std::priority_queue<Rank, std::vector<Rank>, decltype(lower)> queue(lower);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (const auto proposal = propose(groups[g])) queue.emplace(proposal->gain, g);
    }
    while (!queue.empty()) {
      const std::size_t g = queue.top().second;
      queue.pop();
      const auto proposal = propose(groups[g]);
      if (!proposal) continue;
      if (!queue.empty() && proposal->gain < queue.top().first) {
        queue.emplace(proposal->gain, g);
        continue;
      }
      accept(*proposal);
      queue.emplace(0.0, g);  // what it has left over
    }
  }

  std::vector<ChosenClip> finish(std::span<const RepeatGroup> groups) {
    std::vector<long> samples;
    for (const PostureMatrix& take : library_.postures) samples.push_back(take.rows());
    complete_clips(clips_, groups, samples, least_repeated_, stored_);
    return cover_takes(std::move(clips_), samples, least_);
  }

 private:
  /// The longest run of free samples in [begin, end), if it is long enough.
  std::optional<std::pair<long, long>> free_run(std::size_t take, long begin, long end,
                                                long least) const {
    std::pair<long, long> best{0, 0};
    for (long s = begin; s < end; ++s) {
      if (!free_[take][static_cast<std::size_t>(s)]) continue;
      const long first = s;
      while (s < end && free_[take][static_cast<std::size_t>(s)]) ++s;
      if (s - first > best.second - best.first) best = {first, s};
    }
    if (best.second - best.first < least) return std::nullopt;
    return best;
  }

  std::optional<Proposal> propose(const RepeatGroup& group) const {
    const Occurrence& reference = group.occurrences.front();
    const auto known = standing_.find(std::tuple(reference.take, reference.begin, reference.end));
    const bool stands = known != standing_.end();
    const auto run = stands
                         ? std::pair(reference.begin, reference.end)
                         : free_run(reference.take, reference.begin, reference.end, least_primary_);
    if (!run) return std::nullopt;
    Proposal proposal;
    if (stands) proposal.standing = known->second;
    proposal.primary = {reference.take, run->first, run->second, ClipRole::primary, 0, {}};
    const PostureMatrix& own = library_.projected[reference.take];
    double before = primary_cost(own, run->first, run->second), after = before;
    long samples = 0;
    for (std::size_t m = 1; m < group.occurrences.size(); ++m) {
      auto clip = repeat_of(reference, *run, group.occurrences[m], proposal);
      if (!clip) continue;
      const PostureMatrix& take = library_.projected[clip->take];
      const double alone = primary_cost(take, clip->begin, clip->end);
      before += alone;
      after += repeated_cost(take, clip->begin, clip->end, own, clip->reference);
      samples += clip->end - clip->begin;
      proposal.repeated.push_back(std::move(*clip));
    }
    // What stands is stored already, and pays with its first repeat.
    const long least = stands ? 1 : run->second - run->first;
    if (samples < least || after <= 0) return std::nullopt;
    proposal.gain = before / after;
    return proposal;
  }

  /// The free part of a member beside a part of its reference.
  std::optional<ChosenClip> repeat_of(const Occurrence& reference,
                                      const std::pair<long, long>& primary,
                                      const Occurrence& member, const Proposal& proposal) const {
    const auto at = [&](long sample) {
      return member.map[static_cast<std::size_t>(sample - reference.begin)];
    };
    const auto run =
        free_run(member.take, at(primary.first), at(primary.second - 1) + 1, least_repeated_);
    if (!run) return std::nullopt;
    const auto overlaps = [&](const ChosenClip& clip) {
      return clip.take == member.take && run->first < clip.end && clip.begin < run->second;
    };
    if (overlaps(proposal.primary) || std::ranges::any_of(proposal.repeated, overlaps)) {
      return std::nullopt;
    }
    ChosenClip clip{member.take, run->first, run->second, ClipRole::repeated, 0, {}};
    long sample = primary.first;
    for (long s = clip.begin; s < clip.end; ++s) {
      // The nearest sample of the primary whose image is not before this one.
      while (sample + 1 < primary.second && at(sample) < s) ++sample;
      clip.reference.push_back(sample);
    }
    return clip;
  }

  void accept(const Proposal& proposal) {
    const std::size_t primary = proposal.standing.value_or(clips_.size());
    if (proposal.standing) {
      clips_[primary].role = ClipRole::primary;
    } else {
      clips_.push_back(proposal.primary);
      occupy(proposal.primary);
    }
    for (ChosenClip clip : proposal.repeated) {
      clip.primary = primary;
      occupy(clip);
      clips_.push_back(std::move(clip));
    }
  }

  void occupy(const ChosenClip& clip) {
    for (long s = clip.begin; s < clip.end; ++s)
      free_[clip.take][static_cast<std::size_t>(s)] = false;
  }

  const PostureLibrary& library_;
  long least_, least_repeated_, least_primary_;
  std::size_t stored_;  ///< that many of the clips stand
  std::map<std::tuple<std::size_t, long, long>, std::size_t> standing_;  ///< take, begin, end
  std::vector<std::vector<bool>> free_;
  std::vector<ChosenClip> clips_;
};

}  // namespace

std::vector<ChosenClip> choose_clips(const PostureLibrary& library,
                                     std::span<const RepeatGroup> groups,
                                     const RepeatConstants& constants,
                                     const ClipChoiceConstants& choice,
                                     std::span<const ChosenClip> standing) {
  Chooser chooser(library, constants, choice, standing);
  chooser.choose(groups);
  return chooser.finish(groups);
}

}  // namespace reprise

#include "rma/clip_completion.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

namespace reprise {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);
/// The primary of a stored clip whose primary is not looked at.
constexpr std::size_t unknown = none - 1;
/// Other occurrences of a group that are looked at for a stretch: the first ones will do.
constexpr std::size_t most_partners = 32;

/// Samples [begin, end) of a take.
struct Run {
  long begin = 0;
  long end = 0;
  long length() const { return end - begin; }
};

/// A stretch of a take beside another occurrence of its group.
struct Partner {
  Run piece;
  std::size_t take = 0;        ///< of the other occurrence
  std::vector<long> beside;    ///< of each sample of the piece: the other's sample
  std::size_t primary = none;  ///< that has the most of these samples; none: they are free
  long count = 0;              ///< how many it has
  float distance_mm = 0;

  /// More in clips, then nearer.
  bool better_than(const Partner& other) const {
    return std::tuple(primary != none, count, -distance_mm) >
           std::tuple(other.primary != none, other.count, -other.distance_mm);
  }
};

/// The sample of a group's reference beside each of a member's; `member` may be the reference.
std::vector<long> samples_of_reference(const Occurrence& reference, const Occurrence& member,
                                       const Run& piece) {
  std::vector<long> samples;
  long at = reference.begin;
  for (long s = piece.begin; s < piece.end; ++s) {
    if (member.map.empty()) {
      at = s;
    } else {
      while (at + 1 < reference.end &&
             member.map[static_cast<std::size_t>(at - reference.begin)] < s) {
        ++at;
      }
    }
    samples.push_back(at);
  }
  return samples;
}

class Completion {
 public:
  Completion(std::vector<ChosenClip>& clips, std::span<const RepeatGroup> groups,
             std::span<const long> samples, long least, std::size_t standing)
      : clips_(clips), groups_(groups), least_(least), standing_(standing), told_(samples.size()) {
    for (const long count : samples) {
      owner_.emplace_back(static_cast<std::size_t>(count), none);
      recurs_.emplace_back(static_cast<std::size_t>(count), false);
    }
    for (std::size_t c = 0; c < clips.size(); ++c) own(c, clips[c].begin, clips[c].end);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (std::size_t o = 0; o < groups[g].occurrences.size(); ++o) {
        const Occurrence& occurrence = groups[g].occurrences[o];
        told_[occurrence.take].emplace_back(g, o);
        std::fill(recurs_[occurrence.take].begin() + occurrence.begin,
                  recurs_[occurrence.take].begin() + occurrence.end, true);
      }
    }
  }

  void run() {
    for (std::size_t take = 0; take < owner_.size(); ++take) {
      long from = 0;
      while (const auto left = next_left(take, from)) {
        const auto partner = left->length() < least_ ? std::nullopt : best_partner(take, *left);
        if (partner) add(take, *partner);
        from = partner ? left->begin : left->end;
      }
    }
    for (std::size_t take = 0; take < owner_.size(); ++take) {
      long from = 0;
      while (const auto left = next_left(take, from)) {
        if (left->length() < least_) join_neighbour(take, *left);
        from = left->end;
      }
    }
  }

 private:
  void own(std::size_t clip, long begin, long end) {
    const auto owners = owner_[clips_[clip].take].begin();
    std::fill(owners + begin, owners + end, clip);
  }

  std::size_t owner(std::size_t take, long sample) const {
    return owner_[take][static_cast<std::size_t>(sample)];
  }

  bool is_left(std::size_t take, long sample) const {
    return recurs_[take][static_cast<std::size_t>(sample)] && owner(take, sample) == none;
  }

  /// The first run of samples from here on that recur and that no clip has.
  std::optional<Run> next_left(std::size_t take, long from) const {
    const auto count = static_cast<long>(owner_[take].size());
    while (from < count && !is_left(take, from)) ++from;
    Run run{from, from};
    while (run.end < count && is_left(take, run.end)) ++run.end;
    if (run.length() == 0) return std::nullopt;
    return run;
  }

  std::size_t primary_at(std::size_t take, long sample) const {
    const std::size_t clip = owner(take, sample);
    if (clip == none) return none;
    if (clips_[clip].role != ClipRole::repeated) return clip;
    return clips_[clip].primary == clip ? unknown : clips_[clip].primary;
  }

  std::optional<Partner> best_partner(std::size_t take, const Run& left) const {
    std::optional<Partner> best;
    for (const auto& [g, o] : told_[take]) {
      const std::vector<Occurrence>& all = groups_[g].occurrences;
      const Run piece{std::max(left.begin, all[o].begin), std::min(left.end, all[o].end)};
      if (piece.length() < least_) continue;
      const std::vector<long> reference = samples_of_reference(all[0], all[o], piece);
      for (std::size_t other = 0; other < std::min(all.size(), most_partners); ++other) {
        if (other == o) continue;
        const auto partner = partner_of(piece, reference, all[0], all[o], all[other]);
        if (!partner || (best && !partner->better_than(*best))) continue;
        best = partner;
      }
    }
    return best;
  }

  std::optional<Partner> partner_of(const Run& piece, const std::vector<long>& reference,
                                    const Occurrence& first, const Occurrence& own,
                                    const Occurrence& other) const {
    Partner partner{piece, other.take, {}, none, 0, own.distance_mm + other.distance_mm};
    std::vector<std::pair<std::size_t, long>> counts;  // primary, samples
    for (const long r : reference) {
      partner.beside.push_back(
          other.map.empty() ? r : other.map[static_cast<std::size_t>(r - first.begin)]);
      const std::size_t primary = primary_at(other.take, partner.beside.back());
      auto known = std::ranges::find(counts, primary, &std::pair<std::size_t, long>::first);
      if (known == counts.end()) known = counts.insert(counts.end(), {primary, 0});
      ++known->second;
    }
    for (const auto& [primary, count] : counts) {
      if (primary == none || primary == unknown || count <= partner.count) continue;
      partner.primary = primary;
      partner.count = count;
    }
    if (partner.primary != none) return partner;
    if (counts.front().first == unknown || counts.size() > 1) return std::nullopt;
    const auto [begin, end] = std::ranges::minmax(partner.beside);
    if (end + 1 - begin < least_) return std::nullopt;
    return partner;
  }

  void add(std::size_t take, const Partner& partner) {
    std::size_t primary = partner.primary;
    if (primary == none) {
      const auto [begin, end] = std::ranges::minmax(partner.beside);
      primary = clips_.size();
      clips_.push_back({partner.take, begin, end + 1, ClipRole::primary, 0, {}});
      own(primary, begin, end + 1);
    }
    clips_[primary].role = ClipRole::primary;
    const Run kept = part_beside(partner, primary);
    ChosenClip clip{take, kept.begin, kept.end, ClipRole::repeated, primary, {}};
    long at = clips_[primary].begin;
    for (long s = kept.begin; s < kept.end; ++s) {
      const long beside = partner.beside[static_cast<std::size_t>(s - partner.piece.begin)];
      if (primary_at(partner.take, beside) == primary) at = sample_of_primary(partner.take, beside);
      clip.reference.push_back(at);
    }
    // What one occurrence maps forwards another may map back by a sample.
    for (std::size_t s = 1; s < clip.reference.size(); ++s)
      clip.reference[s] = std::max(clip.reference[s], clip.reference[s - 1]);
    clips_.push_back(std::move(clip));
    own(clips_.size() - 1, kept.begin, kept.end);
  }

  /// The part of the piece that is beside the primary, or all where the rest is short.
  Run part_beside(const Partner& partner, std::size_t primary) const {
    const auto is_beside = [&](long s) {
      const long beside = partner.beside[static_cast<std::size_t>(s - partner.piece.begin)];
      return primary_at(partner.take, beside) == primary;
    };
    Run part = partner.piece;
    while (part.begin + 1 < part.end && !is_beside(part.begin)) ++part.begin;
    while (part.begin + 1 < part.end && !is_beside(part.end - 1)) --part.end;
    if (part.begin - partner.piece.begin < least_) part.begin = partner.piece.begin;
    if (partner.piece.end - part.end < least_) part.end = partner.piece.end;
    return part.length() < least_ ? partner.piece : part;
  }

  /// The sample of the primary for a sample that it has, or that one of its repeats has.
  long sample_of_primary(std::size_t take, long sample) const {
    const ChosenClip& clip = clips_[owner(take, sample)];
    if (clip.role != ClipRole::repeated || clip.reference.empty()) {
      return clip.role == ClipRole::repeated ? clips_[clip.primary].begin : sample;
    }
    return clip.reference[static_cast<std::size_t>(sample - clip.begin)];
  }

  void join_neighbour(std::size_t take, const Run& left) {
    const auto at = [&](long sample) {
      const auto count = static_cast<long>(owner_[take].size());
      const std::size_t clip = sample >= 0 && sample < count ? owner(take, sample) : none;
      return clip == none || clip < standing_ ? none : clip;
    };
    const std::size_t before = at(left.begin - 1), after = at(left.end);
    if (before != none) {
      ChosenClip& clip = clips_[before];
      clip.end = left.end;
      if (clip.role == ClipRole::repeated)
        clip.reference.resize(static_cast<std::size_t>(clip.end - clip.begin),
                              clip.reference.back());
      own(before, left.begin, left.end);
    } else if (after != none) {
      ChosenClip& clip = clips_[after];
      clip.begin = left.begin;
      if (clip.role == ClipRole::repeated)
        clip.reference.insert(clip.reference.begin(), static_cast<std::size_t>(left.length()),
                              clip.reference.front());
      own(after, left.begin, left.end);
    }
  }

  std::vector<ChosenClip>& clips_;
  std::span<const RepeatGroup> groups_;
  long least_;
  std::size_t standing_;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> told_;  ///< group, occurrence
  std::vector<std::vector<std::size_t>> owner_;  ///< of each sample of each take: its clip
  std::vector<std::vector<bool>> recurs_;        ///< whether it is in an occurrence
};

}  // namespace

void complete_clips(std::vector<ChosenClip>& clips, std::span<const RepeatGroup> groups,
                    std::span<const long> samples, long least, std::size_t standing) {
  Completion(clips, groups, samples, least, standing).run();
}

}  // namespace reprise

#include "rma/clip_extents.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "rma/parallel_for.h"
#include "rma/plot_places.h"

namespace reprise {
namespace {

/// Extents that share this much of what they cover are one.
constexpr double same_extent = 0.8;

/// Extents of one take, each a running mean of those that are nearly the same.
class ExtentSet {
 public:
  void add(long begin, long end, double support) {
    Mean* best = nullptr;
    double best_overlap = same_extent;
    for (Mean& mean : means_) {
      const double overlap =
          overlap_ratio(begin, end, std::lround(mean.begin), std::lround(mean.end));
      if (overlap >= best_overlap) {
        best_overlap = overlap;
        best = &mean;
      }
    }
    if (best == nullptr) {
      means_.push_back({static_cast<double>(begin), static_cast<double>(end), 1, support});
      return;
    }
    best->count += 1;
    best->begin += (static_cast<double>(begin) - best->begin) / best->count;
    best->end += (static_cast<double>(end) - best->end) / best->count;
    best->support += support;
  }

  void list(std::size_t take, std::vector<ClipExtent>& extents) const {
    for (const Mean& mean : means_) {
      extents.push_back({take, std::lround(mean.begin), std::lround(mean.end), mean.support});
    }
  }

 private:
  struct Mean {
    double begin = 0, end = 0, count = 0, support = 0;
  };
  std::vector<Mean> means_;
};

/// A path within one take may cover more than the lag between its sides; one period is enough.
void part_sides(long& begin, long& end, long& other_begin, long& other_end) {
  if (begin > other_begin) {
    std::swap(begin, other_begin);
    std::swap(end, other_end);
  }
  if (end <= other_begin) return;
  const long lag = other_begin - begin;
  end = begin + lag;
  other_end = std::min(other_end, other_begin + lag);
}

/// Those pairs of a plot that another goes on from, or to; all where `most_samples` is 0.
std::vector<std::size_t> without_lone(std::span<const NearPair> near_pairs,
                                      const std::vector<std::size_t>& pairs, long most_samples) {
  if (most_samples == 0) return pairs;
  const PairPlaces places(near_pairs, pairs);
  std::vector<std::size_t> kept;
  for (const std::size_t i : pairs) {
    if (places.has_next_to(near_pairs[i], most_samples)) kept.push_back(i);
  }
  return kept;
}

/// Adds one side of a path, in equal pieces where it is longer than an extent may be.
void add_side(ExtentSet& extents, long begin, long end, double support, long most) {
  const long length = end - begin, pieces = (length + most - 1) / most;
  for (long piece = 0; piece < pieces; ++piece) {
    extents.add(begin + length * piece / pieces, begin + length * (piece + 1) / pieces,
                support / static_cast<double>(pieces));
  }
}

/// Paths in the plot of two takes, each with the pair that it was traced from. `pairs` are indices.
std::vector<std::pair<std::size_t, TracedPath>> trace_plot(const PostureLibrary& library,
                                                           std::span<const NearPair> near_pairs,
                                                           const std::vector<std::size_t>& pairs,
                                                           const RepeatConstants& constants) {
  PathTracer tracer(constants);
  const long least_path = std::lround(constants.least_path_s * constants.rate);
  const long next_near = std::lround(constants.next_near_s * constants.rate);
  std::vector<std::pair<std::size_t, TracedPath>> traced;
  TracedPlaces places(library.postures[near_pairs[pairs.front()].take].rows());
  for (const std::size_t i : without_lone(near_pairs, pairs, next_near)) {
    const NearPair& pair = near_pairs[i];
    if (places.full()) break;
    if (places.hold(pair)) continue;
    SimilarPath path = tracer.trace(library.side(pair.take, pair.other_take),
                                    library.side(pair.other_take, pair.take),
                                    {pair.sample, pair.other_sample}, pair.take == pair.other_take);
    if (path.pixels.empty()) continue;
    places.add(path);
    traced.push_back({i, {pair.take, pair.other_take, std::move(path)}});
  }
  std::erase_if(traced,
                [&](const auto& t) { return t.second.path.manhattan_length() < least_path; });
  return traced;
}

}  // namespace

double overlap_ratio(long begin_a, long end_a, long begin_b, long end_b) {
  const long common = std::min(end_a, end_b) - std::max(begin_a, begin_b);
  if (common <= 0) return 0;
  return static_cast<double>(common) /
         static_cast<double>(std::max(end_a, end_b) - std::min(begin_a, begin_b));
}

std::vector<TracedPath> trace_paths(const PostureLibrary& library,
                                    std::span<const NearPair> near_pairs,
                                    const RepeatConstants& constants, unsigned jobs) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> by_takes;
  for (std::size_t i = 0; i < near_pairs.size(); ++i) {
    by_takes[{near_pairs[i].take, near_pairs[i].other_take}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> plots;
  for (auto& [takes, pairs] : by_takes) plots.push_back(std::move(pairs));
  std::vector<std::vector<std::pair<std::size_t, TracedPath>>> traced(plots.size());
  parallel_for(plots.size(), jobs, [&](std::size_t plot) {
    traced[plot] = trace_plot(library, near_pairs, plots[plot], constants);
  });
  // In the order of the pairs, whichever plot they are in.
  std::vector<std::pair<std::size_t, TracedPath>> all;
  for (auto& paths : traced) std::ranges::move(paths, std::back_inserter(all));
  std::ranges::sort(all, {}, &std::pair<std::size_t, TracedPath>::first);
  std::vector<TracedPath> paths;
  for (auto& [pair, path] : all) paths.push_back(std::move(path));
  return paths;
}

std::vector<ClipExtent> find_clip_extents(const PostureLibrary& library,
                                          std::span<const NearPair> near_pairs,
                                          const RepeatConstants& constants, unsigned jobs) {
  const long least_clip = std::lround(constants.least_clip_s * constants.rate);
  const long most_clip = std::lround(constants.most_clip_s * constants.rate);
  std::vector<ExtentSet> sets(library.takes());
  for (const TracedPath& traced : trace_paths(library, near_pairs, constants, jobs)) {
    const std::vector<PlotPixel>& pixels = traced.path.pixels;
    long begin = pixels.front().x, end = pixels.back().x + 1;
    long other_begin = pixels.front().y, other_end = pixels.back().y + 1;
    if (traced.take == traced.other_take) part_sides(begin, end, other_begin, other_end);
    if (end - begin < least_clip || other_end - other_begin < least_clip) continue;
    const auto length = static_cast<double>(end - begin);
    const auto other_length = static_cast<double>(other_end - other_begin);
    add_side(sets[traced.take], begin, end, other_length, most_clip);
    add_side(sets[traced.other_take], other_begin, other_end, length, most_clip);
  }
  std::vector<ClipExtent> extents;
  for (std::size_t take = 0; take < sets.size(); ++take) sets[take].list(take, extents);
  std::sort(extents.begin(), extents.end(), [](const ClipExtent& a, const ClipExtent& b) {
    return std::tuple(-a.support, a.take, a.begin, a.end) <
           std::tuple(-b.support, b.take, b.begin, b.end);
  });
  return extents;
}

}  // namespace reprise

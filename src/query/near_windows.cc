#include "query/near_windows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "model/symmetric_eigen.h"
#include "query/window_index.h"
#include "rma/parallel_for.h"

namespace reprise {
namespace {

/// How many times a window's own speed its neighbours may run; steps of about a quarter octave.
constexpr std::array<double, 7> tempos{1.0, 0.79, 1.26, 0.63, 1.59, 0.5, 2.0};

struct Window {
  std::size_t take = 0;
  double centre = 0;  ///< samples
};

/// Windows of all takes as points, and which window each is.
struct WindowPoints {
  std::vector<Window> windows;
  PointMatrix points;
};

/// Windows that last `span` samples: postures at even distances, one after another in a row, scaled
/// so that distances are those of postures on average.
WindowPoints cut_windows(const PostureLibrary& library, std::optional<std::size_t> only_take,
                         double span, double hop, int postures) {
  WindowPoints cut;
  for (std::size_t take = 0; take < library.takes(); ++take) {
    if (only_take && take != *only_take) continue;
    const double last = static_cast<double>(library.projected[take].rows() - 1);
    for (double begin = 0; begin + span <= last; begin += hop) {
      cut.windows.push_back({take, begin + span / 2});
    }
  }
  const long axes = library.projected.empty() ? 0 : library.projected[0].cols();
  cut.points.resize(static_cast<long>(cut.windows.size()), axes * postures);
  for (std::size_t w = 0; w < cut.windows.size(); ++w) {
    const PostureMatrix& take = library.projected[cut.windows[w].take];
    for (int p = 0; p < postures; ++p) {
      const double at = std::max(0.0, cut.windows[w].centre - span / 2 + span * p / (postures - 1));
      const long sample = std::min(static_cast<long>(at), take.rows() - 2);
      const auto part = static_cast<float>(at - static_cast<double>(sample));
      cut.points.row(static_cast<long>(w)).segment(p * axes, axes) =
          ((1 - part) * take.row(sample) + part * take.row(sample + 1)) /
          std::sqrt(static_cast<float>(postures));
    }
  }
  return cut;
}

/// Leading axes of points: columns.
Eigen::MatrixXf leading_axes(const PointMatrix& points, int count) {
  const Eigen::RowVectorXf mean = points.colwise().mean();
  const PointMatrix centred = points.rowwise() - mean;
  const Eigen::MatrixXd products = (centred.transpose() * centred).cast<double>();
  const SymmetricEigen solved = symmetric_eigen(products);
  return solved.vectors.rightCols(std::min<Eigen::Index>(count, products.cols())).cast<float>();
}

struct RankedPair {
  NearPair pair;
  float squared_distance;
};

/// Each pair once, by its least distance; nearest first.
std::vector<NearPair> nearest_first(std::vector<RankedPair> ranked) {
  std::sort(ranked.begin(), ranked.end(), [](const RankedPair& a, const RankedPair& b) {
    return std::tie(a.pair, a.squared_distance) < std::tie(b.pair, b.squared_distance);
  });
  const auto same = [](const RankedPair& a, const RankedPair& b) { return a.pair == b.pair; };
  ranked.erase(std::unique(ranked.begin(), ranked.end(), same), ranked.end());
  std::sort(ranked.begin(), ranked.end(), [](const RankedPair& a, const RankedPair& b) {
    return std::tie(a.squared_distance, a.pair) < std::tie(b.squared_distance, b.pair);
  });
  std::vector<NearPair> pairs;
  pairs.reserve(ranked.size());
  for (const RankedPair& r : ranked) pairs.push_back(r.pair);
  return pairs;
}

/// How far a window's neighbours may be (mm): NearWindowConstants::most_mm, or more in proportion
/// where more is similar.
float near_limit(const PostureLibrary& library, const Window& window,
                 const RepeatConstants& repeats, const NearWindowConstants& constants) {
  const std::vector<float>& similar = library.similar_mm[window.take];
  const auto sample = static_cast<std::size_t>(std::lround(window.centre));
  const float similar_mm = similar[std::min(sample, similar.size() - 1)];
  return constants.most_mm * std::max(1.0F, similar_mm / repeats.similar_mm);
}

NearPair ordered_pair(const Window& a, const Window& b) {
  const NearPair pair{
      static_cast<std::uint32_t>(a.take), static_cast<std::int32_t>(std::lround(a.centre)),
      static_cast<std::uint32_t>(b.take), static_cast<std::int32_t>(std::lround(b.centre))};
  const NearPair turned{pair.other_take, pair.other_sample, pair.take, pair.sample};
  return std::min(pair, turned);
}

}  // namespace

std::vector<NearPair> find_near_pairs(const PostureLibrary& library, const RepeatConstants& repeats,
                                      std::optional<std::size_t> only_take, unsigned jobs,
                                      const NearWindowConstants& constants) {
  constexpr std::size_t block = 256;
  const double span = constants.window_s * repeats.rate, hop = constants.hop_s * repeats.rate;
  const WindowPoints own = cut_windows(library, std::nullopt, span, hop, constants.postures);
  if (own.windows.size() < 2) return {};
  const Eigen::MatrixXf axes = leading_axes(own.points, constants.dimensions);
  const WindowIndex index(PointMatrix(own.points * axes));
  const std::size_t neighbours =
      only_take ? constants.neighbours_of_one_take : constants.neighbours;
  const float across = library.subjects.empty() ? 1.0F : std::max(1.0F, repeats.across_subjects);
  std::vector<RankedPair> ranked;
  for (const double tempo : tempos) {
    const double asked_span = span / tempo, least_lag = std::max(span, asked_span);
    const WindowPoints asked = cut_windows(library, only_take, asked_span, hop, constants.postures);
    const PointMatrix points = asked.points * axes;
    const std::size_t count = asked.windows.size(), blocks = (count + block - 1) / block;
    std::vector<std::vector<RankedPair>> found(blocks);
    parallel_for(blocks, jobs, [&](std::size_t b) {
      for (std::size_t w = b * block; w < std::min(count, (b + 1) * block); ++w) {
        const std::span<const float> point(points.row(static_cast<long>(w)).data(),
                                           static_cast<std::size_t>(points.cols()));
        const Window& window = asked.windows[w];
        const float most_mm = near_limit(library, window, repeats, constants);
        for (const Neighbour& near : index.nearly_nearest(point, neighbours, across * most_mm,
                                                          constants.excess, constants.most_looks)) {
          const Window& other = own.windows[near.point];
          const float most = library.of_one_subject(window.take, other.take)
                                 ? most_mm
                                 : repeats.across_subjects * most_mm;
          if (near.squared_distance > most * most) continue;
          const bool overlaps =
              other.take == window.take && std::abs(other.centre - window.centre) < least_lag;
          if (overlaps) continue;
          found[b].push_back(
              {ordered_pair(window, other), static_cast<float>(near.squared_distance)});
        }
      }
    });
    for (const auto& pairs : found) ranked.insert(ranked.end(), pairs.begin(), pairs.end());
  }
  return nearest_first(std::move(ranked));
}

}  // namespace reprise

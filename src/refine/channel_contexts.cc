#include "refine/channel_contexts.h"

#include <algorithm>
#include <bit>

namespace reprise {
namespace {

using Contexts = ChannelContexts;

constexpr Learning channel_learning = {40, 6, weight_one / 4};
/// What a counter of a size has seen, and one of a sign or of lower bits.
constexpr int size_count = 2, other_count = 4;

/// Logits, in quarters, of a knot being beyond bucket 0 .. 7, by how large the knots around it are:
/// 0, below 1/16, 1/8, .. 64, and from there on. Counted over takes of three sets at bounds of 1
/// and 10 mm, each set with the same weight.
constexpr int known_buckets = 8, known_sizes = 13, least_octave = -5;
constexpr std::array<std::array<std::int8_t, known_sizes>, known_buckets> beyond = {{
    {-24, -17, -15, -12, -10, -5, -2, 0, 1, 2, 3, 6, 6},
    {-8, -10, -9, -8, -7, -5, -2, 1, 3, 4, 5, 8, 8},
    {3, -2, -2, -2, -3, -2, 0, 2, 4, 5, 7, 10, 10},
    {6, 1, 2, 2, 0, 0, 0, 2, 5, 6, 8, 11, 11},
    {5, 2, 2, 2, 0, -2, -2, 0, 2, 4, 5, 9, 10},
    {6, 2, 3, 5, 4, 2, 0, 1, 2, 4, 6, 10, 11},
    {5, 2, 3, 4, 4, 2, 0, -1, -1, 2, 4, 8, 9},
    {5, 2, 3, 5, 5, 4, 3, 2, 1, 3, 5, 9, 10},
}};

/// Sizes have eight bits after the point here.
constexpr int size_one_bits = 8;

/// The middle of a bin of size_bin with one bin an octave, or two.
std::uint64_t middle(std::uint32_t bin, int per_octave) {
  if (bin == 0) return 0;
  const std::uint32_t width = bin / static_cast<std::uint32_t>(per_octave);
  const std::uint64_t least = std::uint64_t{1} << (width - 1 + size_one_bits);
  if (per_octave == 1) return least + least / 2;
  return width == 1 ? least : least + (bin % 2 == 0 ? least / 4 : least / 4 * 3);
}

/// How large a knot may be by a context of a table: sums of the sizes around it over their weights.
std::uint64_t expected_size(std::uint32_t table, std::uint32_t context) {
  const std::uint32_t few = Contexts::few_bins;
  switch (table) {
    case 0:
      return middle(context / Contexts::level_slots, 2) / 48;
    case 1:
      return (2 * middle(context / few, 2) + middle(context % few, 1)) / 40;
    case 2:
      return (middle(context / few, 2) + 20 * middle(context % few, 1)) / 40;
    default:
      return (middle(context / few / few, 2) + 32 * middle(context / few % few, 1) +
              16 * middle(context % few, 1)) /
             96;
  }
}

/// 0 for no size, else its octave, as in `beyond`.
int place_of(std::uint64_t size) {
  if (size == 0) return 0;
  const int octave = static_cast<int>(std::bit_width(size)) - 1 - size_one_bits;
  return std::clamp(octave - least_octave + 1, 1, known_sizes - 1);
}

/// Two buckets are an octave, in which larger knots are as smaller ones an octave below.
int start_of(std::uint32_t bucket, int place) {
  for (; bucket >= known_buckets; bucket -= 2) place = std::max(place - 1, std::min(place, 1));
  return beyond[bucket][static_cast<std::size_t>(place)] * logit_one / 4;
}

BitMixer make_fresh() {
  std::array<std::size_t, BitModelConstants::inputs> sizes;
  for (std::size_t t = 0; t < sizes.size(); ++t)
    sizes[t] = std::size_t{Contexts::kinds} * Contexts::count[t];
  BitMixer mixer(sizes, Contexts::kinds, channel_learning);
  for (std::uint32_t t = 0; t < sizes.size(); ++t) {
    const std::uint32_t count = Contexts::count[t];
    for (std::uint32_t kind = 0; kind < Contexts::kinds; ++kind) {
      const bool of_size = kind < Contexts::decisions;
      if (of_size && t + 1 == sizes.size()) continue;  // channels differ from body to body
      for (std::uint32_t context = 0; context < count; ++context) {
        const int logit = of_size ? start_of(kind, place_of(expected_size(t, context))) : 0;
        mixer.start(t, kind * count + context, logit, of_size ? size_count : other_count);
      }
    }
  }
  return mixer;
}

}  // namespace

const BitMixer& fresh_channel_mixer() {
  static const BitMixer fresh = make_fresh();
  return fresh;
}

}  // namespace reprise

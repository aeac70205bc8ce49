// The order in which the bits of a take's knots are coded, and what each of them depends on
// (docs/format-coefficients.md, Contexts of knots).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "quant/bit_model.h"
#include "quant/knot_contexts.h"
#include "quant/knot_order.h"
#include "quant/magnitude_bins.h"
#include "quant/trajectory_codec.h"

namespace reprise {

/// These belong to the archive format.
struct KnotWalkConstants {
  /// Magnitudes up to this are coded one by one, larger ones by their number of bits.
  static constexpr int unary_limit = 6;
  static constexpr int exponent_bits = 5;
  /// Contexts tell no difference between larger magnitudes than this.
  static constexpr int context_limit = 1 << 20;
  static constexpr std::uint32_t root_slots = 8;
  /// Bits of the number of the last trajectory in use.
  static constexpr std::uint32_t end_slots = 7;
  /// The bin of a scale that is as large as the step.
  static constexpr int scale_bias = 8;

  /// Counters of each table of the mixer that is walked with.
  static std::array<std::size_t, BitModelConstants::inputs> table_sizes() {
    std::array<std::size_t, BitModelConstants::inputs> sizes;
    for (std::size_t t = 0; t < sizes.size(); ++t)
      sizes[t] = decision_count * KnotContexts::count[t] + 1;
    sizes[0] += (std::size_t{KnotContexts::slots} << end_slots) + (1u << exponent_bits);
    return sizes;
  }
};

/// Walks over the knots, coarse to fine, frame by frame, and codes each bit with `io`, which
/// writes, reads or learns.
template <class Io>
class KnotWalk : KnotWalkConstants {
  using Index = Eigen::Index;

 public:
  KnotWalk(Io io, const KnotScales& scales, const KnotShape& shape, QuantisedKnots& knots)
      : io_(io), scales_(scales), shape_(shape), knots_(knots) {}

  void run() {
    for (const KnotGroup& group : knot_order(shape_)) {
      const int end = code_end(group);
      for (const KnotRow& row : group.rows) {
        if constexpr (requires { io_.ran_out(); }) {
          if (io_.ran_out()) return;
        }
        for (int column = group.first_column; column < end; ++column) code_knot(group, row, column);
      }
    }
  }

 private:
  static int sign_code(int value) { return value < 0 ? 1 : value > 0 ? 2 : 0; }

  /// One past the last trajectory that has a knot in this group.
  int code_end(const KnotGroup& group) {
    int end = group.first_column;
    for (const KnotRow& row : group.rows) {
      for (int column = group.last_column - 1; column >= end; --column) {
        if (knots_(row.row, column) != 0) end = column + 1;
      }
    }
    const auto slot = u(group.slot);
    const auto most = static_cast<unsigned>(group.last_column - group.first_column);
    const unsigned used = static_cast<unsigned>(end - group.first_column);
    std::uint32_t node = 1;
    for (int b = std::bit_width(most) - 1; b >= 0; --b) {
      const std::uint32_t bits = std::min<std::uint32_t>(node, (1u << end_slots) - 1);
      BitMixer::Contexts contexts;
      for (std::uint32_t t = 0; t < BitModelConstants::inputs; ++t) {
        contexts.counter[t] =
            decision_count * KnotContexts::count[t] + (t == 0 ? slot << end_slots | bits : 0);
      }
      contexts.weights = decision_count;
      node = node << 1 | io_(contexts, (used >> b & 1) != 0);
    }
    return group.first_column +
           static_cast<int>(std::min(node - (1u << std::bit_width(most)), most));
  }

  /// A knot that is coded already, as contexts see it; 0 outside.
  int at(Index frame, int column) const {
    const bool inside =
        frame >= 0 && frame < shape_.frames && column >= 0 && column < shape_.trajectories;
    return inside ? std::clamp(knots_(frame, column), -context_limit, context_limit) : 0;
  }

  void code_knot(const KnotGroup& group, const KnotRow& row, int column) {
    const Index frame = row.row;
    const bool coarsest = group.coarsest;
    const auto slot = u(group.slot);
    const int before = at(row.before, column), before_that = at(row.before_that, column);
    const int left = at(row.left, column), right = at(row.right, column);
    const int beside = at(frame, column - 1), beside_that = at(frame, column - 2);
    const int predicted = coarsest ? prediction(row.before, column) : 0;
    // Far above the prediction only what differs from it counts.
    const int a = std::abs(coarsest && predicted != 0 ? before - before_that : before);
    const int a2 = coarsest ? 0 : std::abs(before_that);
    const int parents = std::abs(left) + std::abs(right);
    const int neighbours = 2 * std::abs(beside) + std::abs(beside_that);
    const std::uint32_t column_slot =
        column < shape_.root ? u(column)
        : column >= shape_.trajectories - shape_.direct
            ? KnotContexts::columns - 1
            : std::min<std::uint32_t>(root_slots + u(column - shape_.root),
                                      KnotContexts::columns - 2);
    const auto expected =
        u(std::clamp(scales_.at(shape_, group.slot, column) - shape_.step_half_octaves + scale_bias,
                     0, static_cast<int>(KnotContexts::scales) - 1));
    base_[0] = expected * KnotContexts::slots + slot;
    base_[1] =
        (slot * KnotContexts::magnitudes + magnitude_bin(2 * a + a2)) * KnotContexts::magnitudes +
        magnitude_bin(parents);
    base_[2] = (magnitude_bin(neighbours) * KnotContexts::magnitudes + magnitude_bin(a)) *
                   KnotContexts::magnitudes +
               magnitude_bin(parents);
    base_[3] = expected / 2 * KnotContexts::fine_magnitudes +
               fine_magnitude_bin(2 * a + a2 + parents + neighbours);
    base_[4] = slot * KnotContexts::columns + column_slot;
    const int signs[4] = {sign_code(before), sign_code(left), sign_code(right), sign_code(beside)};
    if constexpr (requires { io_.wanted(frame, column); }) {
      knots_(frame, column) = predicted + chosen(io_.wanted(frame, column) - predicted);
    }
    // In unsigned arithmetic: a damaged stream may ask for any sum.
    const auto residual = static_cast<std::int32_t>(
        static_cast<std::uint32_t>(knots_(frame, column)) - static_cast<std::uint32_t>(predicted));
    knots_(frame, column) =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(predicted) +
                                  static_cast<std::uint32_t>(code_value(residual, signs)));
  }

  /// The root's place and direct channels stay where they are sooner than they go back to their
  /// mean.
  int prediction(Index before, int column) const {
    const bool follows = column < shape_.root || column >= shape_.trajectories - shape_.direct;
    return follows && before >= 0 ? knots_(before, column) : 0;
  }

  BitMixer::Contexts contexts_of(std::uint32_t decision) const {
    BitMixer::Contexts contexts;
    for (std::uint32_t t = 0; t < BitModelConstants::inputs; ++t) {
      contexts.counter[t] = decision * KnotContexts::count[t] + base_[t];
    }
    contexts.weights = decision;
    return contexts;
  }

  bool decide(std::uint32_t decision, bool bit) { return io_(contexts_of(decision), bit); }

  /// The value near `wanted` that costs least, error and bits together.
  int chosen(double wanted) {
    const double size = std::abs(wanted);
    const int nearest = static_cast<int>(std::lround(size));
    if (nearest == 0 || nearest > unary_limit) return wanted < 0 ? -nearest : nearest;
    constexpr double sign_bits = 1;
    double above = 0;  // bits that say that the magnitude is more than those before
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int magnitude = 0; magnitude <= nearest; ++magnitude) {
      static_assert(is_more_than == is_not_zero + 1);
      const auto decision = u(magnitude);
      const double stop = io_.bits(contexts_of(decision), false);
      const double error = size - magnitude;
      const double cost =
          error * error + io_.lambda * (above + stop + (magnitude > 0 ? sign_bits : 0));
      if (cost < least) {
        least = cost;
        best = magnitude;
      }
      above += io_.bits(contexts_of(decision), true);
    }
    return wanted < 0 ? -best : best;
  }

  int code_value(int value, const int (&signs)[4]) {
    // Of a reader a value is what a damaged stream has made of it: any at all.
    const std::int64_t magnitude = std::abs(std::int64_t{value});
    if (!decide(is_not_zero, magnitude > 0)) return 0;
    int known = 1;
    while (known <= unary_limit && decide(is_more_than + u(known - 1), magnitude > known)) ++known;
    if (known > unary_limit) known += code_rest(magnitude - known);
    base_[1] = u(signs[0] * 27 + signs[1] * 9 + signs[2] * 3 + signs[3]);
    base_[2] = u(signs[0] * 3 + signs[3]);
    base_[3] = u(signs[1] * 3 + signs[2]);
    base_[4] = u(signs[0]);
    return decide(sign_is_negative, value < 0) ? -known : known;
  }

  static constexpr std::uint32_t u(int value) { return static_cast<std::uint32_t>(value); }

  /// Numbers beyond the unary ones: how many bits, then the bits.
  int code_rest(std::int64_t rest) {
    const std::uint32_t plus_one = static_cast<std::uint32_t>(rest) + 1;
    std::uint32_t node = 1;
    BitMixer::Contexts contexts;
    for (std::uint32_t t = 0; t < BitModelConstants::inputs; ++t) {
      contexts.counter[t] =
          decision_count * KnotContexts::count[t] + (KnotContexts::slots << end_slots);
    }
    contexts.weights = decision_count;
    const auto width = static_cast<std::uint32_t>(std::bit_width(plus_one));
    for (int b = exponent_bits - 1; b >= 0; --b) {
      contexts.counter[0] =
          decision_count * KnotContexts::count[0] + (KnotContexts::slots << end_slots) + node;
      for (std::uint32_t t = 1; t < BitModelConstants::inputs; ++t) {
        contexts.counter[t] = decision_count * KnotContexts::count[t];
      }
      node = node << 1 | io_(contexts, (width >> b & 1) != 0);
    }
    const std::uint32_t bits = node - (1u << exponent_bits);
    const std::uint32_t coded =
        bits == 0 ? 1 : (1u << (bits - 1)) | io_.plain(plus_one, static_cast<int>(bits) - 1);
    return static_cast<int>((coded - 1) & 0x3fffffff);
  }

  Io io_;
  const KnotScales& scales_;
  const KnotShape& shape_;
  QuantisedKnots& knots_;
  std::array<std::uint32_t, BitModelConstants::inputs> base_{};
};

}  // namespace reprise

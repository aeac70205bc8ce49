// What the markers of a principal axis do, foretold from those before them. Markers move as points
// of rigid bodies: where two of a body are known, so is about how it turns, and with it where its
// next one goes (docs/format-coefficients.md, Entries of axes). Integers only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ingest/marker_layout.h"

namespace reprise {

/// Three numbers of a marker: its entries on an axis, in steps.
using MarkerEntries = std::array<std::int64_t, 3>;

/// These belong to the archive format.
struct AxisPredictionConstants {
  /// Turns are in parts of this of an entry's step, for a step of the mean.
  static constexpr int turn_bits = 16;
  /// Larger arms (steps of the mean) and turns are cut to these: sums stay within 64 bits.
  static constexpr std::int64_t most_arm = 1 << 15;
  static constexpr std::int64_t most_turn = 1 << 24;
  /// Squared steps of the mean that are added to an arm's square: short arms tell little of a turn.
  static constexpr std::int64_t arm_noise = 20;
};

class AxisPredictor {
 public:
  /// `mean` has the mean posture, three whole numbers a marker; without it nothing turns.
  AxisPredictor(const MarkerLayout& layout, std::span<const std::int32_t> mean);

  /// Begins an axis: nothing of it is known.
  void begin();

  struct Foretold {
    MarkerEntries base{};  ///< those of the marker's anchor
    MarkerEntries turn{};  ///< what its body's turn adds, in 1 / 2^turn_bits
  };
  /// Markers are gone through in their order.
  Foretold foretell(std::size_t marker);
  void learn(std::size_t marker, const MarkerEntries& entries);

  std::size_t markers() const { return parts_.size(); }
  /// The marker of which a marker's contexts are: its anchor, or the one before an off-bone one.
  int neighbour(std::size_t marker) const { return parts_[marker].neighbour; }
  /// 0 to 3: an off-bone marker adds 2, one whose body has a marker before it 1.
  int kind(std::size_t marker) const { return parts_[marker].kind; }

 private:
  /// What a marker is a part of.
  struct Part {
    int body = -1;    ///< the joint that it moves rigidly with
    int anchor = -1;  ///< the marker at that joint's place, or the nearest one above it
    int neighbour = -1;
    int kind = 0;
    MarkerEntries arm{};  ///< from the anchor, or from the body's place (steps of the mean)
  };
  MarkerEntries& turn_of(int body);

  std::vector<Part> parts_;
  std::vector<int> parents_;          ///< of joints
  std::vector<MarkerEntries> turns_;  ///< of joints
  std::vector<bool> turns_known_;
  std::vector<MarkerEntries> entries_;
};

}  // namespace reprise

// Quantised knots to bytes and back.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "quant/bit_model.h"
#include "quant/range_coder.h"

namespace reprise {

/// frames x trajectories, the places of NestedKnots.
using QuantisedKnots = Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What the decoder must know before the knots.
struct KnotShape {
  long frames = 0;
  int trajectories = 0;
  int root = 0;    ///< how many of them, the first ones, are the root's track
  int direct = 0;  ///< how many of them, the last ones, are direct channels
  int levels = 0;
  /// The finest level counted in frames of 120 Hz, so that takes of all rates share what was
  /// learned of a level: 0 at 120 Hz, 1 at 60 Hz, 2 at 30 Hz.
  int first_level = 0;
};
int first_level_of(double frame_rate);

/// Contexts of all decisions, learned from takes; one model is made for a space and copied for each
/// take.
class KnotModel {
 public:
  KnotModel();

  void encode(RangeEncoder& encoder, const KnotShape& shape, const QuantisedKnots& knots);
  QuantisedKnots decode(RangeDecoder& decoder, const KnotShape& shape);
  /// Learns from knots; returns what they would cost, in bits.
  double learn(const KnotShape& shape, const QuantisedKnots& knots);

  std::vector<std::uint8_t> prior() const { return mixer_.prior(); }
  bool load_prior(std::span<const std::uint8_t> bytes) { return mixer_.load_prior(bytes); }

 private:
  BitMixer mixer_;
};

}  // namespace reprise

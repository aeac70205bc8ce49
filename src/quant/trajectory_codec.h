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
  int step_half_octaves = 0;  ///< logarithm of the quantiser's step (mm)
};
int first_level_of(double frame_rate);

/// How large the knots of each trajectory and level are over the takes of a space (root mean
/// square): what the coder expects before it has seen any. Levels are counted from 120 Hz; the last
/// row is the coarsest knots.
class KnotScales {
 public:
  static constexpr int level_slots = 14;
  /// Logarithms in half octaves; a trajectory that never moves has the least.
  static constexpr int least = -20, most = 43;

  /// Sums up unquantised knots (mm); tumbling takes say nothing of the root's columns.
  void add(const KnotShape& shape, const Eigen::MatrixXd& knots);
  /// Ends the summing.
  void settle();

  /// `trajectories` is root + axes + direct channels of a take.
  int at(const KnotShape& shape, int level_slot, int column) const;

  /// Row by row, for the space's prior.
  std::vector<std::int8_t> codes;  ///< level_slots x columns
  int columns = 0;

 private:
  int column_of(const KnotShape& shape, int column) const;
  std::vector<double> squares_, counts_;
};

/// Row of a level in KnotScales.
int level_slot(const KnotShape& shape, int level);

/// Contexts of all decisions, learned from takes; one model is made for a space and copied for each
/// take.
class KnotModel {
 public:
  explicit KnotModel(KnotScales scales = {});

  void encode(RangeEncoder& encoder, const KnotShape& shape, const QuantisedKnots& knots);
  QuantisedKnots decode(RangeDecoder& decoder, const KnotShape& shape);
  /// Learns from knots; returns what they would cost, in bits.
  double learn(const KnotShape& shape, const QuantisedKnots& knots);
  /// Rounds `knots`, which are in steps, so that squared error plus `lambda` times bits is small:
  /// each in turn, with what was learned of those before it. Learns from what it chooses.
  QuantisedKnots choose(const KnotShape& shape, const Eigen::MatrixXd& knots, double lambda);

  /// What was learned, as bytes; a model made with the same scales starts from them. False: not a
  /// prior.
  std::vector<std::uint8_t> prior(bool with_contexts) const;
  bool load_prior(std::span<const std::uint8_t> bytes);

 private:
  KnotScales scales_;
  BitMixer mixer_;
};

}  // namespace reprise

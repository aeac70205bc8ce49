// Quantised knots to bytes and back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "quant/bit_model.h"
#include "quant/knot_order.h"
#include "quant/range_coder.h"

namespace reprise {

/// frames x trajectories, the places of NestedKnots.
using QuantisedKnots = Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// How large the knots of each trajectory and slot are over the takes of a space (root mean
/// square): what the coder expects before it has seen any.
class KnotScales {
 public:
  /// Logarithms in half octaves; a trajectory that never moves has the least.
  static constexpr int least = -20, most = 43;

  /// Sums up unquantised knots (mm); tumbling takes say nothing of the root's columns.
  void add(const KnotShape& shape, const Eigen::MatrixXd& knots);
  /// Ends the summing.
  void settle();

  /// `trajectories` is root + axes + direct channels of a take.
  int at(const KnotShape& shape, int slot, int column) const;

  /// Row by row, for the space's prior.
  std::vector<std::int8_t> codes;  ///< KnotSlots::count x columns
  int columns = 0;
  /// The kinds whose scales are stored; of another all are the least.
  std::array<bool, curve_kinds> kinds{};
  void keep(const std::array<bool, curve_kinds>& kept);

 private:
  int column_of(const KnotShape& shape, int column) const;
  std::vector<double> squares_, counts_;
};

/// Contexts of all decisions, learned from takes; one model is made for a space and copied for each
/// take.
class KnotModel {
 public:
  explicit KnotModel(KnotScales scales = {});

  void encode(RangeEncoder& encoder, const KnotShape& shape, const QuantisedKnots& knots);
  QuantisedKnots decode(RangeDecoder& decoder, const KnotShape& shape);
  /// Learns from knots; returns what they would cost, in bits.
  double learn(const KnotShape& shape, const QuantisedKnots& knots);
  const std::array<bool, curve_kinds>& kinds() const { return scales_.kinds; }
  /// Rounds `knots`, which are in steps, so that squared error plus `lambda` times bits is small:
  /// each in turn, with what was learned of those before it. Learns from what it chooses.
  struct Choice {
    QuantisedKnots knots;
    double cost = 0;  ///< squared error over lambda, plus bits
  };
  Choice choose(const KnotShape& shape, const Eigen::MatrixXd& knots, double lambda);

  /// From here on learns what takes have in common, slowly, instead of one take.
  void learn_in_common();

  /// What was learned, as bytes; a model made with the same scales starts from them. False: not a
  /// prior.
  std::vector<std::uint8_t> prior(bool with_contexts) const;
  bool load_prior(std::span<const std::uint8_t> bytes);

 private:
  KnotScales scales_;
  BitMixer mixer_;
};

}  // namespace reprise

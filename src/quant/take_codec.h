// One take of `preview` fidelity as bytes and back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contacts/contact_detection.h"
#include "ingest/trajectories.h"
#include "quant/space_codec.h"
#include "quant/trajectory_codec.h"

namespace reprise {

/// Constants of the quantiser.
struct QuantiserConstants {
  /// Steps are powers of 2^(1/32) of a millimetre, from 2^-5 mm on: a take's error comes within a
  /// hundredth of what it may be.
  static constexpr int steps_per_octave = 32;
  static constexpr int step_of_one_mm = 160;
  static constexpr int most_step = 511;
  /// What a bit may add to the squared error, in squared steps; docs/findings has what was tried.
  static constexpr double lambda = 0.10;
};

/// The quantisation step (mm) of an index 0 .. most_step.
double quantiser_step(int index);
/// The index of the step nearest to `millimetres`.
int step_index_of(double millimetres);
/// The step's logarithm as contexts use it (KnotShape), rounded down.
int half_octaves(int step_index);

struct TakeShape {
  long frames = 0;
  double frame_rate = 0;
};

/// Trajectories as knots, not yet quantised.
struct TakeKnots {
  KnotShape shape;
  bool tumbles = false;
  Eigen::MatrixXd knots;
};
/// How the coefficients of the axes, and the root and direct channels, are written.
struct CurveKinds {
  CurveKind coefficients = CurveKind::nested_knots;
  CurveKind root = CurveKind::nested_knots;
};
TakeKnots take_knots(const CoefficientSpace& space, const TakeShape& take, bool tumbles,
                     TrajectoryMatrix trajectories, CurveKinds kinds = {});
/// The pairs of kinds that a take may be written in.
std::vector<CurveKinds> possible_kinds(const KnotModel& model, long frames);

/// Chooses quantised knots by error and bits, with contexts that start as `model`.
KnotModel::Choice quantise(const KnotModel& model, const TakeKnots& knots, int step_index);
/// Trajectories as the decoder sees them.
TrajectoryMatrix dequantise(const QuantisedKnots& quantised, const KnotShape& shape,
                            int step_index);

/// What decoding a take needs besides its space.
struct CodedMotion {
  bool tumbles = false;
  int step_index = 0;
  CurveKinds kinds;
  std::vector<BranchSwitch> switches;
  QuantisedKnots knots;
  TakeContacts contacts = {};  ///< of the legs of the space's reference skeleton
};

std::vector<std::uint8_t> encode_motion(const KnotModel& model, const CoefficientSpace& space,
                                        const TakeShape& take, const CodedMotion& motion);
/// Throws Error (damaged).
CodedMotion decode_motion(const KnotModel& model, const CoefficientSpace& space,
                          const TakeShape& take, std::span<const std::uint8_t> bytes);

/// Trajectories to channels, feet held where they stand: what a decoder makes of a motion.
ChannelMatrix motion_channels(const CoefficientSpace& space, const Skeleton& skeleton,
                              const ChannelConstants& constants, const TakeShape& take,
                              const CodedMotion& motion);

/// From bytes to channels, on the skeleton of the take. Throws Error (damaged).
ChannelMatrix decode_take(const CodedSpace& space, const Skeleton& skeleton,
                          const ChannelConstants& constants, const TakeShape& take,
                          std::span<const std::uint8_t> bytes);

}  // namespace reprise

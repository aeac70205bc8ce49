// A coefficient space as bytes: choices, mean posture, axes at the precision that they need, and
// what the coder has learned.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ingest/trajectories.h"
#include "quant/trajectory_codec.h"

namespace reprise {

/// A space as the decoder knows it, and what the encoder derives from that.
struct CodedSpace {
  CoefficientSpace space;  ///< mean and axes as decoded
  KnotModel model;         ///< where every take's contexts start
  std::vector<std::uint8_t> prior;
};

/// How fine mean and axes are: what they may add to the error of a point (mm, root mean square).
struct SpacePrecision {
  double mean_step_mm = 1.0;
  double axis_error_mm = 1.0;
};

/// Bytes of a space without its prior.
std::vector<std::uint8_t> encode_space(const CoefficientSpace& space,
                                       const SpacePrecision& precision);

/// The same of a space that extends another: only the axes from `known_axes` on.
std::vector<std::uint8_t> encode_extension(const CoefficientSpace& space, int known_axes,
                                           const SpacePrecision& precision);

/// `reference` is the skeleton of the layout; `base` the space that this one extends, or null.
/// Throws Error (damaged).
CoefficientSpace decode_space(std::span<const std::uint8_t> bytes, const Skeleton& reference,
                              const CoefficientSpace* base);

/// Gives a decoded space the values that channels often have; one that never moved starts there.
void set_known_values(KnownValues known, CoefficientSpace& space);

/// The whole blob of a space: known values (none of an extension), the space's bytes, the prior.
std::vector<std::uint8_t> pack_space(std::span<const std::uint8_t> known,
                                     std::span<const std::uint8_t> space,
                                     std::span<const std::uint8_t> prior);
/// Known values alone, without decoding axes. Throws Error (damaged).
KnownValues unpack_known_values(std::span<const std::uint8_t> blob, std::size_t channels);
CodedSpace unpack_space(std::span<const std::uint8_t> blob, const Skeleton& reference,
                        const CoefficientSpace* base);

}  // namespace reprise

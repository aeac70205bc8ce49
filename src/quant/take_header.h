// What of a take is said apart from its curves, in front of every layer that codes them: channels
// that do not move, how the source wrote its angles, and a first frame that is no part of the
// motion. What is left, the prepared take, is smooth, and all that coders see.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ingest/trajectories.h"
#include "model/angle_branches.h"
#include "model/constant_channels.h"
#include "reprise/model/take.h"

namespace reprise {

struct TakeHeader {
  ChannelConstants constants;         ///< of the prepared take
  std::vector<AngleBranch> branches;  ///< frames of the prepared take
  /// A number a channel: the source's first frame, where it is apart; else empty.
  std::vector<double> first_frame;

  bool operator==(const TakeHeader&) const = default;
};

/// A take as coders see it: without a first frame that is apart, channels that do not move
/// constant, angles smooth.
struct PreparedTake {
  Take take;
  TakeHeader header;
};
PreparedTake prepare_take(const Take& take);

/// The way back from decoded channels of the prepared take: frames x channels of the source.
ChannelMatrix restore_take(const Skeleton& skeleton, const TakeHeader& header,
                           ChannelMatrix prepared);

/// Frames of the prepared take, of a source of so many.
long prepared_frames(const TakeHeader& header, long frames);

/// A header and a layer's own data, and back. `known` has a list a channel, or is empty; `frames`
/// are the source's.
std::vector<std::uint8_t> join_header(const Skeleton& skeleton, const KnownValues& known,
                                      long frames, const TakeHeader& header,
                                      std::span<const std::uint8_t> data);
struct SplitLayer {
  TakeHeader header;
  std::span<const std::uint8_t> data;  ///< a part of the bytes
};
/// Throws Error (damaged).
SplitLayer split_header(const Skeleton& skeleton, const KnownValues& known, long frames,
                        std::span<const std::uint8_t> bytes);

}  // namespace reprise

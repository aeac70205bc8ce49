#include "quant/take_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "model/first_frame.h"
#include "quant/bit_model.h"
#include "quant/decimal_values.h"
#include "quant/numbers.h"
#include "reprise/error.h"

namespace reprise {
namespace {

using Eigen::Index;

/// Precision of a first frame that is apart, for all the chains of joints that it turns.
constexpr int first_frame_degree_decimals = 5;
constexpr double first_frame_mm = 1e-4;
/// Least and most bytes that say how long a header is.
constexpr std::size_t most_length_bytes = 4;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the motion of a take is not as it was written");
}

int decimals_of(const Skeleton& skeleton, Channel kind) {
  if (is_rotation(kind)) return first_frame_degree_decimals;
  const double finest = first_frame_mm / skeleton.millimetres_per_unit;
  return std::clamp(static_cast<int>(std::ceil(-std::log10(finest))), 0,
                    ConstantChannelLimits::decimals);
}

struct Writer {
  RangeEncoder encoder;
  bool bit(BitCounter& counter, bool value) {
    encoder.encode(value, std::clamp<Probability>(counter.probability, 64, 65472));
    counter.update(value);
    return value;
  }
  std::uint32_t number(std::uint32_t value) {
    encode_number(encoder, value);
    return value;
  }
  std::int32_t signed_number(std::int32_t value) {
    encode_signed(encoder, value);
    return value;
  }
  std::uint32_t plain(std::uint32_t value, int bits) {
    encoder.encode_plain(value, bits);
    return value;
  }
  double value(double number) {
    encode_decimal(encoder, number);
    return number;
  }
  void check() const {}
};

struct Reader {
  RangeDecoder decoder;
  bool bit(BitCounter& counter, bool) {
    const bool value = decoder.decode(std::clamp<Probability>(counter.probability, 64, 65472));
    counter.update(value);
    return value;
  }
  std::uint32_t number(std::uint32_t) { return decode_number(decoder); }
  std::int32_t signed_number(std::int32_t) { return decode_signed(decoder); }
  std::uint32_t plain(std::uint32_t, int bits) { return decoder.decode_plain(bits); }
  double value(double) { return decode_decimal(decoder); }
  void check() const {
    if (decoder.ran_out()) throw_damaged();
  }
};

/// Codes a header with a Writer, or fills it with a Reader.
template <class Io>
class HeaderCoder {
 public:
  HeaderCoder(Io& io, const Skeleton& skeleton, const KnownValues& known, long frames,
              TakeHeader& header)
      : io_(io), skeleton_(skeleton), known_(known), frames_(frames), header_(header) {}

  void run() {
    header_.constants.resize(static_cast<std::size_t>(skeleton_.channel_count));
    each_channel([&](const Joint& joint, std::size_t c) { code_constant(joint, c); });
    code_first_frame();
    code_branches();
    io_.check();
  }

 private:
  template <class Visit>
  void each_channel(Visit&& visit) {
    for (const Joint& joint : skeleton_.joints) {
      for (std::size_t c = 0; c < joint.channels.size(); ++c) visit(joint, c);
    }
  }

  /// What a channel is likely to be: a known value, or the joint's offset.
  std::vector<double> candidates(const Joint& joint, std::size_t c) const {
    const std::size_t channel = static_cast<std::size_t>(joint.first_channel) + c;
    std::vector<double> values;
    if (channel < known_.size()) values = known_[channel];
    double likely = 0;
    if (is_position(joint.channels[c])) {
      likely = rounded_to_decimals(joint.offset[axis_of(joint.channels[c])],
                                   ConstantChannelLimits::decimals);
    }
    if (std::ranges::find(values, likely) == values.end()) values.push_back(likely);
    return values;
  }

  /// A value that is a candidate, or any other.
  double code_value(const std::vector<double>& likely, double value) {
    const auto at = static_cast<std::size_t>(std::ranges::find(likely, value) - likely.begin());
    std::size_t index = 0;
    while (index < likely.size()) {
      BitCounter& counter = not_candidate_[std::min(index, not_candidate_.size() - 1)]
                                          [std::min(last_choice_, not_candidate_.size() - 1)];
      if (!io_.bit(counter, index != at)) break;
      ++index;
    }
    last_choice_ = index;
    return index < likely.size() ? likely[index] : io_.value(value);
  }

  void code_constant(const Joint& joint, std::size_t c) {
    const std::size_t channel = static_cast<std::size_t>(joint.first_channel) + c;
    auto& constant = header_.constants[channel];
    const std::size_t known = channel < known_.size() && !known_[channel].empty() ? 1 : 0;
    const std::size_t turns = is_rotation(joint.channels[c]) ? 1 : 0;
    last_constant_ =
        io_.bit(is_constant_[known][turns][last_constant_ ? 1 : 0], constant.has_value());
    io_.check();
    if (last_constant_) constant = code_value(candidates(joint, c), constant.value_or(0));
  }

  void code_first_frame() {
    if (io_.plain(header_.first_frame.empty() ? 0 : 1, 1) == 0) return;
    header_.first_frame.resize(header_.constants.size());
    each_channel([&](const Joint& joint, std::size_t c) {
      const std::size_t channel = static_cast<std::size_t>(joint.first_channel) + c;
      std::vector<double> likely = candidates(joint, c);
      const auto& constant = header_.constants[channel];
      if (constant && std::ranges::find(likely, *constant) == likely.end()) {
        likely.insert(likely.begin(), *constant);
      }
      double& value = header_.first_frame[channel];
      value = code_value(likely, value);
      io_.check();
    });
  }

  void code_branches() {
    const std::uint32_t count = io_.number(static_cast<std::uint32_t>(header_.branches.size()));
    const auto joint_bits = static_cast<int>(std::bit_width(skeleton_.joints.size() - 1));
    const auto frame_bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(frames_)));
    std::int64_t frame = 0;
    for (std::uint32_t b = 0; b < count; ++b) {
      if (b == header_.branches.size()) header_.branches.emplace_back();
      AngleBranch& branch = header_.branches[b];
      const bool another = io_.plain(branch.frame != frame ? 1 : 0, 1) != 0;
      if (another) frame = io_.plain(static_cast<std::uint32_t>(branch.frame), frame_bits);
      const std::uint32_t index = io_.plain(static_cast<std::uint32_t>(branch.joint), joint_bits);
      io_.check();
      if (frame >= frames_ || index >= skeleton_.joints.size()) throw_damaged();
      branch.frame = static_cast<std::int32_t>(frame);
      branch.joint = static_cast<std::int32_t>(index);
      const Joint& joint = skeleton_.joints[index];
      branch.turns.resize(joint.rotation_slots.size());
      if (has_second_angles(joint)) branch.flipped = io_.bit(flipped_, branch.flipped);
      for (std::int32_t& turns : branch.turns) {
        if (!io_.bit(turned_, turns != 0)) continue;
        turns = io_.signed_number(turns);
        if (std::abs(std::int64_t{turns}) > most_turns) throw_damaged();
      }
    }
  }

  Io& io_;
  const Skeleton& skeleton_;
  const KnownValues& known_;
  std::int64_t frames_;
  TakeHeader& header_;
  bool last_constant_ = false;
  std::size_t last_choice_ = 0;
  BitCounter is_constant_[2][2][2];
  std::array<std::array<BitCounter, 4>, 4> not_candidate_;
  BitCounter flipped_, turned_;
};

std::vector<double> first_frame_of(const Take& take) {
  std::vector<double> frame;
  for (const Joint& joint : take.skeleton->joints) {
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      frame.push_back(
          rounded_to_decimals(take.channels(0, joint.first_channel + static_cast<Index>(c)),
                              decimals_of(*take.skeleton, joint.channels[c])));
    }
  }
  return frame;
}

}  // namespace

PreparedTake prepare_take(const Take& take) {
  PreparedTake prepared{take, {}};
  ChannelMatrix& channels = prepared.take.channels;
  const Skeleton& skeleton = *take.skeleton;
  if (first_frame_is_apart(take)) {
    prepared.header.first_frame = first_frame_of(take);
    channels = take.channels.bottomRows(take.frames() - 1).eval();
  }
  ChannelConstants& constants = prepared.header.constants;
  constants = find_constants(skeleton, channels);
  set_constants(constants, channels);
  // A channel that does not move in the whole take comes out with one value.
  const ChannelConstants of_all = find_constants(skeleton, take.channels);
  for (std::size_t c = 0; c < prepared.header.first_frame.size(); ++c) {
    if (of_all[c]) prepared.header.first_frame[c] = *constants[c];
  }
  prepared.header.branches = smooth_angles(skeleton, constants, channels);
  return prepared;
}

ChannelMatrix restore_take(const Skeleton& skeleton, const TakeHeader& header,
                           ChannelMatrix prepared) {
  set_constants(header.constants, prepared);
  restore_angles(skeleton, header.branches, prepared);
  if (header.first_frame.empty()) return prepared;
  ChannelMatrix channels(prepared.rows() + 1, prepared.cols());
  channels.bottomRows(prepared.rows()) = prepared;
  for (std::size_t c = 0; c < header.first_frame.size(); ++c) {
    channels(0, static_cast<Index>(c)) = header.first_frame[c];
  }
  return channels;
}

long prepared_frames(const TakeHeader& header, long frames) {
  return header.first_frame.empty() ? frames : frames - 1;
}

std::vector<std::uint8_t> join_header(const Skeleton& skeleton, const KnownValues& known,
                                      long frames, const TakeHeader& header,
                                      std::span<const std::uint8_t> data) {
  Writer writer;
  TakeHeader copy = header;
  HeaderCoder(writer, skeleton, known, frames, copy).run();
  const std::vector<std::uint8_t> coded = writer.encoder.finish();
  std::vector<std::uint8_t> bytes;
  std::size_t size = coded.size();
  for (; size >= 128; size >>= 7) bytes.push_back(static_cast<std::uint8_t>(size | 128));
  bytes.push_back(static_cast<std::uint8_t>(size));
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

SplitLayer split_header(const Skeleton& skeleton, const KnownValues& known, long frames,
                        std::span<const std::uint8_t> bytes) {
  std::size_t size = 0, at = 0;
  for (int shift = 0;; shift += 7) {
    if (at >= bytes.size() || at >= most_length_bytes) throw_damaged();
    size |= std::size_t{bytes[at] & 127u} << shift;
    if ((bytes[at++] & 128) == 0) break;
  }
  if (size > bytes.size() - at) throw_damaged();
  SplitLayer split{{}, bytes.subspan(at + size)};
  Reader reader{RangeDecoder(bytes.subspan(at, size))};
  HeaderCoder(reader, skeleton, known, frames, split.header).run();
  if (!split.header.first_frame.empty() && frames < 2) throw_damaged();
  return split;
}

}  // namespace reprise

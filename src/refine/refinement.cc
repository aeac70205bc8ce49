#include "refine/refinement.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "quant/catmull_rom.h"
#include "quant/numbers.h"
#include "refine/channel_coder.h"
#include "refine/pose_metric.h"
#include "reprise/error.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t most_bytes_past_end = 16;
constexpr int step_bits = 9, step_zero = 320, steps_per_octave = 8;
constexpr int least_step = 0, most_step = (1 << step_bits) - 1;
/// Rounding of what is written as text with six decimals, and of other machines' sines.
constexpr double rounding_mm = 0.001, rounding_part = 0.001;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the motion of a take is not as it was written");
}

/// Degrees or file units of a step, by its index.
double step_of(int index) {
  static constexpr double eighths[steps_per_octave] = {1.0,
                                                       1.0905077326652577,
                                                       1.1892071150027210,
                                                       1.2968395546510096,
                                                       1.4142135623730951,
                                                       1.5422108254079407,
                                                       1.6817928305074290,
                                                       1.8340080864093424};
  const int from_zero = index - step_zero + 1024;
  return std::ldexp(eighths[from_zero % steps_per_octave],
                    from_zero / steps_per_octave - 1024 / steps_per_octave);
}

int step_index(double step) {
  if (!(step > 0)) return least_step;
  const double octaves = std::clamp(std::log2(step), -60.0, 60.0);
  return std::clamp(static_cast<int>(std::lround(octaves * steps_per_octave)) + step_zero,
                    least_step, most_step);
}

/// What the bytes say.
struct CodedChannels {
  std::vector<int>
      steps;  ///< of each channel in coding order; -1: its numbers are stored as they are
  ChannelKnots knots;
  ChannelMatrix stored;  ///< columns of channels that are stored as they are
};

ChannelKnotShape knot_shape(const Skeleton& skeleton, const TakeShape& shape) {
  return {shape.frames, knot_levels(shape.frame_rate, shape.frames),
          first_level_of(shape.frame_rate), coding_parents(skeleton)};
}

MatrixXd trajectory(const ChannelKnots& knots, Index place, double step, int levels) {
  MatrixXd column = knots.col(place).cast<double>() * step;
  NestedKnots::to_frames(column, levels);
  return column;
}

ChannelMatrix to_channels(const Skeleton& skeleton, const ChannelKnotShape& shape,
                          const CodedChannels& coded) {
  ChannelMatrix channels(shape.frames, skeleton.channel_count);
  const std::vector<int> order = coding_order(skeleton);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto place = static_cast<Index>(i);
    if (coded.steps[i] < 0) {
      channels.col(order[i]) = coded.stored.col(place);
    } else {
      channels.col(order[i]) =
          trajectory(coded.knots, place, step_of(coded.steps[i]), shape.levels);
    }
  }
  return channels;
}

std::vector<std::uint8_t> to_bytes(const ChannelKnotShape& shape, const CodedChannels& coded) {
  RangeEncoder encoder;
  int before = step_zero;
  for (std::size_t i = 0; i < coded.steps.size(); ++i) {
    const auto place = static_cast<Index>(i);
    encoder.encode_plain(coded.steps[i] < 0, 1);
    if (coded.steps[i] < 0) {
      for (Index f = 0; f < shape.frames; ++f) {
        const auto bits = std::bit_cast<std::uint64_t>(coded.stored(f, place));
        encoder.encode_plain(static_cast<std::uint32_t>(bits >> 32), 32);
        encoder.encode_plain(static_cast<std::uint32_t>(bits), 32);
      }
      continue;
    }
    encode_signed(encoder, coded.steps[i] - before);
    before = coded.steps[i];
  }
  ChannelCoder().encode(encoder, shape, coded.knots);
  return encoder.finish();
}

CodedChannels from_bytes(const ChannelKnotShape& shape, std::span<const std::uint8_t> bytes) {
  RangeDecoder decoder(bytes);
  CodedChannels coded;
  const auto channels = static_cast<Index>(shape.parents.size());
  coded.stored = ChannelMatrix::Zero(shape.frames, channels);
  int before = step_zero;
  for (Index place = 0; place < channels; ++place) {
    if (decoder.bytes_past_end() > most_bytes_past_end) throw_damaged();
    if (decoder.decode_plain(1) != 0) {
      coded.steps.push_back(-1);
      for (Index f = 0; f < shape.frames; ++f) {
        const std::uint64_t high = decoder.decode_plain(32);
        const double value = std::bit_cast<double>(high << 32 | decoder.decode_plain(32));
        if (!std::isfinite(value)) throw_damaged();
        coded.stored(f, place) = value;
      }
      continue;
    }
    const std::int64_t step = std::int64_t{before} + decode_signed(decoder);
    if (step < least_step || step > most_step) throw_damaged();
    before = static_cast<int>(step);
    coded.steps.push_back(before);
  }
  coded.knots = ChannelCoder().decode(decoder, shape);
  if (decoder.bytes_past_end() > most_bytes_past_end) throw_damaged();
  return coded;
}

class Refiner {
 public:
  Refiner(const Take& take, double bound_mm)
      : take_(take),
        bound_(bound_mm),
        order_(coding_order(*take.skeleton)),
        shape_(knot_shape(*take.skeleton, {take.frames(), take.frame_rate})),
        positions_(joint_positions(*take.skeleton, take.channels)) {
    measure();
  }

  Refinement run() {
    // The coarsest step that keeps the bound; errors do not fall with every step, so what is kept
    // is checked.
    int low = least_step, high = step_index(4 * bound_);
    Refinement best;
    bool found = false;
    while (low <= high) {
      const int middle = (low + high) / 2;
      CodedChannels coded = quantise(step_of(middle));
      const ChannelMatrix decoded = to_channels(*take_.skeleton, shape_, coded);
      const double worst = worst_distance(decoded);
      if (worst <= bound_ * (1 - rounding_part) - rounding_mm) {
        best.bytes = to_bytes(shape_, coded);
        best.decoded = decoded;
        best.max_mm = worst;
        found = true;
        low = middle + 1;
      } else {
        high = middle - 1;
      }
    }
    if (!found) {
      CodedChannels coded = quantise(0);
      best.bytes = to_bytes(shape_, coded);
      best.decoded = take_.channels;
    }
    return best;
  }

 private:
  void measure() {
    const auto channels = order_.size();
    metrics_.resize(static_cast<std::size_t>(shape_.frames) * channels);
    PoseMetric metric(*take_.skeleton);
    const std::vector<double> weights(take_.skeleton->joints.size(), 1.0);
    for (Index f = 0; f < shape_.frames; ++f) {
      metric.measure({take_.channels.row(f).data(), channels}, weights,
                     std::span(metrics_).subspan(static_cast<std::size_t>(f) * channels, channels));
    }
  }

  const ChannelMetric& metric(Index frame, std::size_t place) const {
    return metrics_[static_cast<std::size_t>(frame) * order_.size() + place];
  }

  CodedChannels quantise(double step_mm) const {
    CodedChannels coded;
    const auto channels = static_cast<Index>(order_.size());
    coded.knots = ChannelKnots::Zero(shape_.frames, channels);
    coded.stored = ChannelMatrix::Zero(shape_.frames, channels);
    std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>> twists(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const auto place = static_cast<Index>(i);
      const int parent = shape_.parents[i];
      twists[i] = parent < 0 ? Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, shape_.frames)
                             : twists[static_cast<std::size_t>(parent)];
      MatrixXd column = take_.channels.col(order_[i]);
      double weight = 0;
      for (Index f = 0; f < shape_.frames; ++f) {
        column(f, 0) -= metric(f, i).compensation.dot(twists[i].col(f));
        weight += metric(f, i).weight;
      }
      weight /= static_cast<double>(shape_.frames);
      const int index = step_index(step_mm / std::sqrt(weight));
      const double step = step_of(index);
      NestedKnots::from_frames(column, shape_.levels);
      if (step_mm <= 0 || !(column.cwiseAbs().maxCoeff() / step < most_knot)) {
        coded.steps.push_back(-1);
        coded.stored.col(place) = take_.channels.col(order_[i]);
        continue;
      }
      coded.steps.push_back(index);
      for (Index f = 0; f < shape_.frames; ++f) {
        const double value = column(f, 0) / step;
        const double rounding =
            knot_level(f, shape_.levels) == shape_.levels ? 0.5 : 0.5 - dead_zone_;
        const double magnitude = std::floor(std::abs(value) + rounding);
        coded.knots(f, place) = static_cast<std::int32_t>(value < 0 ? -magnitude : magnitude);
      }
      const MatrixXd decoded = trajectory(coded.knots, place, step, shape_.levels);
      for (Index f = 0; f < shape_.frames; ++f) {
        twists[i].col(f) += metric(f, i).motion * (decoded(f, 0) - take_.channels(f, order_[i]));
      }
    }
    return coded;
  }

  double worst_distance(const ChannelMatrix& decoded) const {
    if (!decoded.allFinite()) return INFINITY;
    const PositionMatrix reached = joint_positions(*take_.skeleton, decoded);
    double worst = 0;
    for (Index f = 0; f < reached.rows(); ++f) {
      for (Index j = 0; j < reached.cols(); j += 3) {
        worst = std::max(
            worst, (reached.row(f).segment<3>(j) - positions_.row(f).segment<3>(j)).squaredNorm());
      }
    }
    return std::sqrt(worst);
  }

  static constexpr double dead_zone_ = 0.1;
  const Take& take_;
  double bound_;
  std::vector<int> order_;
  ChannelKnotShape shape_;
  PositionMatrix positions_;
  std::vector<ChannelMetric> metrics_;
};

}  // namespace

Refinement refine(const Take& take, const ChannelMatrix*, double bound_mm, const RefinementModel&) {
  return Refiner(take, bound_mm).run();
}

ChannelMatrix decode_refinement(const Skeleton& skeleton, const TakeShape& shape,
                                const ChannelMatrix*, std::span<const std::uint8_t> bytes,
                                const RefinementModel&) {
  const ChannelKnotShape knots = knot_shape(skeleton, shape);
  return to_channels(skeleton, knots, from_bytes(knots, bytes));
}

}  // namespace reprise

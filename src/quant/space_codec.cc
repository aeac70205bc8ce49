#include "quant/space_codec.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "quant/axis_coder.h"
#include "quant/known_values.h"
#include "quant/numbers.h"
#include "reprise/error.h"

namespace reprise {
namespace {

using Eigen::Index;

/// Angles that change are only looked near; what never changes is held at its value.
constexpr double active_start_degrees = 15.0;
constexpr double resting_step = 0.001;  // degrees or units of the file
/// Steps of the precision parameters: powers of 2^(1/4).
constexpr double quarter_octave = 1.189207115002721;
constexpr int precision_bias = 64;
constexpr std::uint32_t most_axes = 4096;
constexpr std::size_t length_bytes = 4;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the axes of a coefficient space are not as they were written");
}

double precision_of(std::uint32_t index) {
  return std::pow(quarter_octave, static_cast<int>(index) - precision_bias);
}

std::uint32_t index_of_precision(double value) {
  const auto index = std::lround(std::log(value) / std::log(quarter_octave)) + precision_bias;
  return static_cast<std::uint32_t>(std::clamp<long>(index, 0, 127));
}

/// Step of the entries of an axis, from its standard deviation (mm) in powers of 2^(1/2).
double axis_step(double axis_error, double deviation) { return axis_error / deviation; }

double deviation_of(std::uint32_t index) { return std::pow(2.0, index / 2.0 - 8.0); }
std::uint32_t index_of_deviation(double deviation) {
  return static_cast<std::uint32_t>(
      std::clamp<long>(std::lround(2.0 * (std::log2(std::max(deviation, 1e-3)) + 8.0)), 0, 63));
}

/// Entries of an orthonormal axis are about 1/sqrt(dimensions): how many steps that is, as its
/// logarithm.
int size_class(double step, int dimensions) {
  return static_cast<int>(std::lround(2.0 * std::log2(1.0 / (step * std::sqrt(dimensions))))) + 4;
}

struct Writer {
  RangeEncoder encoder;
  bool operator()(Probability one, bool value) {
    encoder.encode(value, one);
    return value;
  }
  std::int32_t number(std::int32_t value) {
    encode_signed(encoder, value);
    return value;
  }
  std::uint32_t plain(std::uint32_t value, int bits) {
    encoder.encode_plain(value, bits);
    return value;
  }
  void axis(AxisCoder& coder, const AxisScale& scale, std::span<std::int32_t> entries) {
    coder.encode(encoder, scale, entries);
  }
};

struct Reader {
  RangeDecoder decoder;
  bool operator()(Probability one, bool) { return decoder.decode(one); }
  std::int32_t number(std::int32_t) { return decode_signed(decoder); }
  std::uint32_t plain(std::uint32_t, int bits) { return decoder.decode_plain(bits); }
  void axis(AxisCoder& coder, const AxisScale& scale, std::span<std::int32_t> entries) {
    if (!coder.decode(decoder, scale, entries)) throw_damaged();
  }
  bool ran_out() const { return decoder.ran_out(); }
};

template <class Io>
void code_choices(Io& io, LayoutChoices& choices, std::size_t channels, std::size_t joints) {
  choices.through_markers = io.plain(choices.through_markers, 1) != 0;
  BitCounter after[2];
  bool before = true;
  choices.active.resize(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    BitCounter& counter = after[before];
    before = io(std::clamp<Probability>(counter.probability, 64, 65536 - 64), choices.active[c]);
    counter.update(before);
    choices.active[c] = before;
  }
  choices.root_joint = io.number(choices.root_joint);
  choices.up_axis = static_cast<int>(io.plain(static_cast<std::uint32_t>(choices.up_axis), 3));
  if (choices.root_joint < 0 || choices.root_joint >= static_cast<int>(joints) ||
      choices.up_axis > 5) {
    throw_damaged();
  }
}

template <class Io>
void code_start(Io& io, CoefficientSpace& space, std::size_t channels) {
  space.start.resize(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    const double step = space.layout.choices.active[c] ? active_start_degrees : resting_step;
    const double wanted = std::clamp(space.start[c] / step, -1e9, 1e9);
    space.start[c] = io.number(static_cast<std::int32_t>(std::lround(wanted))) * step;
  }
}

std::int32_t in_steps(double value, double step) {
  constexpr double most = AxisCoder::most_entry;
  return static_cast<std::int32_t>(std::lround(std::clamp(value / step, -most, most)));
}

template <class Io>
void code_mean(Io& io, CoefficientSpace& space, double step) {
  const int dimensions = space.layout.dimensions();
  space.mean.conservativeResizeLike(Eigen::VectorXd::Zero(dimensions));
  space.mean_steps.resize(static_cast<std::size_t>(dimensions));
  for (Index d = 0; d < dimensions; ++d)
    space.mean_steps[static_cast<std::size_t>(d)] = in_steps(space.mean[d], step);
  AxisCoder coder(space.layout, {});
  io.axis(coder, {}, space.mean_steps);
  for (Index d = 0; d < dimensions; ++d)
    space.mean[d] = space.mean_steps[static_cast<std::size_t>(d)] * step;
}

/// Codes the axes from `first` on; a reader has made room for them.
template <class Io>
void code_axes(Io& io, CoefficientSpace& space, Index first, double axis_error) {
  AxisCoder coder(space.layout, space.mean_steps);
  const int dimensions = space.layout.dimensions();
  std::vector<std::int32_t> entries(static_cast<std::size_t>(dimensions));
  std::optional<int> before;
  for (Index k = first; k < space.axes.cols(); ++k) {
    const auto deviation =
        io.plain(index_of_deviation(std::sqrt(std::max(space.variance[k], 0.0))), 6);
    space.variance[k] = deviation_of(deviation) * deviation_of(deviation);
    const double step = axis_step(axis_error, deviation_of(deviation));
    const int half_octaves = static_cast<int>(deviation);
    for (Index d = 0; d < dimensions; ++d)
      entries[static_cast<std::size_t>(d)] = in_steps(space.axes(d, k), step);
    io.axis(coder, {size_class(step, dimensions), half_octaves - before.value_or(half_octaves)},
            entries);
    before = half_octaves;
    for (Index d = 0; d < dimensions; ++d)
      space.axes(d, k) = entries[static_cast<std::size_t>(d)] * step;
  }
}

template <class Io>
void code_space(Io& io, CoefficientSpace& space, const Skeleton& reference, Index known_axes,
                bool extends, SpacePrecision precision) {
  const auto channels = static_cast<std::size_t>(reference.channel_count);
  precision.mean_step_mm = precision_of(io.plain(index_of_precision(precision.mean_step_mm), 7));
  precision.axis_error_mm = precision_of(io.plain(index_of_precision(precision.axis_error_mm), 7));
  if (!extends) {
    code_choices(io, space.layout.choices, channels, reference.joints.size());
    if (space.layout.reference.joints.empty()) {
      space.layout = make_marker_layout(reference, space.layout.choices);
    }
    code_start(io, space, channels);
    code_mean(io, space, precision.mean_step_mm);
  }
  const std::uint32_t more =
      io.plain(static_cast<std::uint32_t>(space.axes.cols() - known_axes), 12);
  if (more > 0 && space.layout.dimensions() == 0) throw_damaged();
  if (more + known_axes > std::min<Index>(most_axes, space.layout.dimensions())) throw_damaged();
  // A reader's new numbers are looked at before they are read, so that they have to be some.
  space.axes.conservativeResizeLike(
      Eigen::MatrixXd::Zero(space.layout.dimensions(), known_axes + more));
  space.variance.conservativeResizeLike(Eigen::VectorXd::Zero(known_axes + more));
  code_axes(io, space, known_axes, precision.axis_error_mm);
}

/// A channel that never moved starts at the commonest of its values.
bool starts_at_known_value(const CoefficientSpace& space, std::size_t channel) {
  return channel < space.known.size() && !space.known[channel].empty() &&
         !space.layout.choices.active[channel];
}

/// Cuts a part that its length stands before off the front of `blob`.
std::span<const std::uint8_t> take_part(std::span<const std::uint8_t>& blob) {
  if (blob.size() < length_bytes) throw_damaged();
  std::size_t size = 0;
  for (std::size_t byte = 0; byte < length_bytes; ++byte)
    size |= std::size_t{blob[byte]} << (8 * byte);
  if (size > blob.size() - length_bytes) throw_damaged();
  const auto part = blob.subspan(length_bytes, size);
  blob = blob.subspan(length_bytes + size);
  return part;
}

}  // namespace

std::vector<std::uint8_t> encode_space(const CoefficientSpace& space,
                                       const SpacePrecision& precision) {
  Writer writer;
  CoefficientSpace copy = space;
  for (std::size_t c = 0; c < copy.start.size(); ++c) {
    if (starts_at_known_value(copy, c)) copy.start[c] = 0;
  }
  code_space(writer, copy, space.layout.reference, 0, false, precision);
  return writer.encoder.finish();
}

std::vector<std::uint8_t> encode_extension(const CoefficientSpace& space, int known_axes,
                                           const SpacePrecision& precision) {
  Writer writer;
  CoefficientSpace copy = space;
  code_space(writer, copy, space.layout.reference, known_axes, true, precision);
  return writer.encoder.finish();
}

CoefficientSpace decode_space(std::span<const std::uint8_t> bytes, const Skeleton& reference,
                              const CoefficientSpace* base) {
  Reader reader{RangeDecoder(bytes)};
  CoefficientSpace space;
  if (base != nullptr) space = *base;
  code_space(reader, space, reference, space.axes.cols(), base != nullptr, {});
  if (reader.ran_out()) throw_damaged();
  return space;
}

void set_known_values(KnownValues known, CoefficientSpace& space) {
  space.known = std::move(known);
  for (std::size_t c = 0; c < space.start.size(); ++c) {
    if (starts_at_known_value(space, c)) space.start[c] = space.known[c].front();
  }
}

std::vector<std::uint8_t> pack_space(std::span<const std::uint8_t> known,
                                     std::span<const std::uint8_t> space,
                                     std::span<const std::uint8_t> prior) {
  std::vector<std::uint8_t> blob;
  for (const std::span<const std::uint8_t> part : {known, space}) {
    for (std::size_t byte = 0; byte < length_bytes; ++byte) {
      blob.push_back(static_cast<std::uint8_t>(part.size() >> (8 * byte)));
    }
    blob.insert(blob.end(), part.begin(), part.end());
  }
  blob.insert(blob.end(), prior.begin(), prior.end());
  return blob;
}

KnownValues unpack_known_values(std::span<const std::uint8_t> blob, std::size_t channels) {
  return decode_known_values(take_part(blob), channels);
}

CodedSpace unpack_space(std::span<const std::uint8_t> blob, const Skeleton& reference,
                        const CoefficientSpace* base) {
  const std::span<const std::uint8_t> known = take_part(blob), space = take_part(blob);
  CodedSpace coded;
  coded.space = decode_space(space, reference, base);
  if (base == nullptr) {
    set_known_values(decode_known_values(known, static_cast<std::size_t>(reference.channel_count)),
                     coded.space);
  }
  coded.prior.assign(blob.begin(), blob.end());
  if (!coded.model.load_prior(coded.prior)) throw_damaged();
  return coded;
}

}  // namespace reprise

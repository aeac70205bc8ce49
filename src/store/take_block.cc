#include "store/take_block.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <functional>

#include "reprise/error.h"
#include "store/compression.h"
#include "store/number_columns.h"

namespace reprise {
namespace {

/// Names, subjects, descriptions and tags of a block together (bytes).
constexpr std::size_t most_texts = std::size_t{1} << 28;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the archive is damaged: a block of takes makes no sense");
}

/// Names of the parts of coded motion, in the order of their numbers. Never change one.
const std::vector<std::string>& part_names() {
  static const std::vector<std::string> names = {"curves",      "repeats", "contacts",  "root",
                                                 "corrections", "text",    "refinement"};
  return names;
}

std::uint64_t size_of_layer(const StoredTake& take, std::size_t layer) {
  return layer < take.places.size() ? take.places[layer].size : 0;
}

std::uint64_t size_of_layers(const StoredTake& take) {
  std::uint64_t sum = 0;
  for (const LayerPlace& place : take.places) sum += place.size;
  return sum;
}

std::int64_t difference(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::int64_t>(a - b);
}

/// The texts of a take, in the order in which blocks hold them.
template <class Info>
auto texts_of(Info& info) {
  return std::array{&info.name, &info.subject, &info.description, &info.tags};
}

class Packer {
 public:
  explicit Packer(const TakeBlock& block) : takes_(block.takes) {}

  Bytes pack() {
    writer_.number(takes_.size());
    pack_numbers();
    pack_errors();
    pack_layers();
    pack_spent();
    pack_clips();
    pack_texts();
    return writer_.finish();
  }

 private:
  using Value = std::function<std::uint64_t(const StoredTake&)>;
  /// One number of each take.
  void column(const Value& value) {
    std::vector<std::uint64_t> values;
    for (const StoredTake& take : takes_) values.push_back(value(take));
    writer_.numbers(values);
  }
  /// As many numbers of each take as it has, all in one column.
  void columns(const std::function<std::size_t(const StoredTake&)>& count,
               const std::function<std::uint64_t(const StoredTake&, std::size_t)>& value) {
    std::vector<std::uint64_t> values;
    for (const StoredTake& take : takes_) {
      for (std::size_t i = 0; i < count(take); ++i) values.push_back(value(take, i));
    }
    writer_.numbers(values);
  }

  void pack_numbers() {
    std::size_t next = 0;
    column([&](const StoredTake& take) {
      const std::size_t gap = take.slot - next;
      next = take.slot + 1;
      return gap;
    });
    column([](const StoredTake& t) { return static_cast<std::uint64_t>(t.record.proportions); });
    column([](const StoredTake& t) { return static_cast<std::uint64_t>(t.record.space); });
    column([](const StoredTake& t) { return static_cast<std::uint64_t>(t.record.info.frames); });
    const auto tier = [](const StoredTake& t) { return t.record.info.fidelity.tier; };
    column([&](const StoredTake& t) { return static_cast<std::uint64_t>(tier(t)); });
    column([](const StoredTake& t) {
      return std::bit_cast<std::uint64_t>(t.record.info.fidelity.limit_mm);
    });
    // Files of a kind have much the same size a frame.
    const auto frames = [](const StoredTake& t) {
      return static_cast<std::uint64_t>(std::max(1L, t.record.info.frames));
    };
    column([&](const StoredTake& t) { return t.record.info.text_bytes / frames(t); });
    column([&](const StoredTake& t) { return t.record.info.text_bytes % frames(t); });
  }

  void pack_errors() {
    const auto error = [&](double PositionErrors::*member) {
      column([member](const StoredTake& t) {
        return static_cast<std::uint64_t>(micrometres(t.record.info.error_mm.*member));
      });
    };
    error(&PositionErrors::mean);
    error(&PositionErrors::rms);
    error(&PositionErrors::p99);
    error(&PositionErrors::max);
    const auto sketch_size = [](const StoredTake& t) { return t.record.error_quantiles.size(); };
    column(sketch_size);
    std::size_t most = 0;
    for (const StoredTake& take : takes_) most = std::max(most, sketch_size(take));
    for (std::size_t q = 0; q < most; ++q) {
      // Quantiles rise.
      columns([&](const StoredTake& t) -> std::size_t { return q < sketch_size(t) ? 1 : 0; },
              [&](const StoredTake& t, std::size_t) {
                const int before = q == 0 ? 0 : t.record.error_quantiles[q - 1];
                return static_cast<std::uint64_t>((t.record.error_quantiles[q] - before) & 255);
              });
    }
  }

  void pack_layers() {
    const auto count = [](const StoredTake& t) { return t.places.size(); };
    column(count);
    const auto layer = [](const StoredTake& t, std::size_t i) -> const LayerRecord& {
      return t.record.layers[i];
    };
    columns(count, [&](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(layer(t, i).kind);
    });
    columns(count, [&](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(layer(t, i).base);
    });
    columns(count, [&](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(micrometres(layer(t, i).limit_mm));
    });
    columns(count, size_of_layer);
    columns(count, [](const StoredTake& t, std::size_t i) -> std::uint64_t {
      return t.places[i].compressed ? 1 : 0;
    });
    for (const StoredTake& take : takes_) {
      for (const LayerPlace& place : take.places) writer_.raw(place.digest);
    }
  }

  void pack_spent() {
    const auto count = [](const StoredTake& t) { return t.record.spent.size(); };
    column(count);
    columns(count, [](const StoredTake& t, std::size_t i) {
      return part_number(t.record.spent[i].first);
    });
    // Often a part is a layer.
    columns(count, [](const StoredTake& t, std::size_t i) {
      return folded(difference(t.record.spent[i].second, size_of_layer(t, i)));
    });
  }

  void pack_clips() {
    const auto count = [](const StoredTake& t) -> std::size_t { return t.clip ? 1 : 0; };
    column(count);
    columns(count, [](const StoredTake& t, std::size_t) {
      return static_cast<std::uint64_t>(t.clip->group);
    });
    columns(count, [](const StoredTake& t, std::size_t) {
      return folded(difference(t.clip->bytes, size_of_layers(t)));
    });
    for (const StoredTake& take : takes_) {
      if (take.clip) writer_.raw(address_bytes(take.clip->address));
    }
  }

  static ShortDigest address_bytes(std::uint64_t address) {
    ShortDigest bytes;
    for (std::size_t b = 0; b < bytes.size(); ++b)
      bytes[b] = static_cast<std::uint8_t>(address >> (56 - 8 * b));
    return bytes;
  }

  void pack_texts() {
    column([](const StoredTake& t) { return t.record.info.source_digest.size() / 2; });
    for (const StoredTake& take : takes_)
      writer_.raw(from_hexadecimal(take.record.info.source_digest));
    std::string all;
    for (std::size_t text = 0; text < 4; ++text) {
      column([&](const StoredTake& t) { return texts_of(t.record.info)[text]->size(); });
      for (const StoredTake& take : takes_) all += *texts_of(take.record.info)[text];
    }
    const Bytes frame = compress(bytes_of(all), true);
    const bool smaller = frame.size() < all.size();
    writer_.number(smaller ? 1 : 0);
    writer_.raw(smaller ? std::span<const std::uint8_t>(frame) : bytes_of(all));
  }

  const std::vector<StoredTake>& takes_;
  ColumnWriter writer_;
};

class Unpacker {
 public:
  Unpacker(std::int64_t id, std::span<const std::uint8_t> bytes) : reader_(bytes) {
    block_.id = id;
  }

  TakeBlock unpack() {
    const std::uint64_t count = reader_.number();
    if (count > TakeBlockLimits::takes) throw_damaged();
    block_.takes.resize(count);
    unpack_numbers();
    unpack_errors();
    unpack_layers();
    unpack_spent();
    unpack_clips();
    unpack_texts();
    return std::move(block_);
  }

 private:
  std::vector<StoredTake>& takes() { return block_.takes; }

  template <class Put>
  void column(const Put& put) {
    const std::vector<std::uint64_t> values = reader_.numbers(takes().size());
    for (std::size_t i = 0; i < values.size(); ++i) put(takes()[i], values[i]);
  }
  /// How many numbers each take has of something that it has at most `most` of.
  template <class Resize>
  void counts(std::size_t most, const Resize& resize) {
    column([&](StoredTake& take, std::uint64_t count) {
      if (count > most) throw_damaged();
      resize(take, static_cast<std::size_t>(count));
    });
  }
  template <class Count, class Put>
  void columns(const Count& count, const Put& put) {
    std::size_t all = 0;
    for (const StoredTake& take : takes()) all += count(take);
    const std::vector<std::uint64_t> values = reader_.numbers(all);
    std::size_t next = 0;
    for (StoredTake& take : takes()) {
      const std::size_t own = count(take);
      for (std::size_t i = 0; i < own; ++i) put(take, i, values[next++]);
    }
  }

  /// A number that must be below a bound, to be used as one of another type.
  template <class Number>
  static Number checked(std::uint64_t value, std::uint64_t most) {
    if (value > most) throw_damaged();
    return static_cast<Number>(value);
  }

  void unpack_numbers() {
    constexpr std::uint64_t most_id = std::uint64_t{1} << 62, most_frames = std::uint64_t{1} << 40;
    std::size_t next = 0;
    column([&](StoredTake& take, std::uint64_t gap) {
      take.slot = next + checked<std::size_t>(gap, TakeBlockLimits::takes);
      if (take.slot >= TakeBlockLimits::takes) throw_damaged();
      next = take.slot + 1;
      take.record.info.id = block_.id_of(take);
    });
    column([&](StoredTake& t, std::uint64_t v) {
      t.record.proportions = checked<std::int64_t>(v, most_id);
    });
    column([&](StoredTake& t, std::uint64_t v) {
      t.record.space = checked<std::int64_t>(v, most_id);
    });
    column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.frames = checked<long>(v, most_frames);
    });
    column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.fidelity.tier = checked<FidelityTier>(v, 255);
    });
    column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.fidelity.limit_mm = std::bit_cast<double>(v);
    });
    column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.text_bytes = checked<std::uint64_t>(v, most_frames) *
                                 static_cast<std::uint64_t>(std::max(1L, t.record.info.frames));
    });
    column([&](StoredTake& t, std::uint64_t v) { t.record.info.text_bytes += v; });
  }

  void unpack_errors() {
    const auto error = [&](double PositionErrors::*member) {
      column([member](StoredTake& t, std::uint64_t v) {
        t.record.info.error_mm.*member = static_cast<double>(v) / 1000.0;
      });
    };
    error(&PositionErrors::mean);
    error(&PositionErrors::rms);
    error(&PositionErrors::p99);
    error(&PositionErrors::max);
    std::size_t most = 0;
    counts(TakeBlockLimits::quantiles, [&](StoredTake& take, std::size_t count) {
      take.record.error_quantiles.resize(count);
      most = std::max(most, count);
    });
    for (std::size_t q = 0; q < most; ++q) {
      columns(
          [&](const StoredTake& t) -> std::size_t {
            return q < t.record.error_quantiles.size() ? 1 : 0;
          },
          [&](StoredTake& t, std::size_t, std::uint64_t v) {
            const int before = q == 0 ? 0 : t.record.error_quantiles[q - 1];
            t.record.error_quantiles[q] =
                static_cast<std::uint8_t>(before + static_cast<int>(v & 255));
          });
    }
  }

  void unpack_layers() {
    counts(most_layers, [](StoredTake& take, std::size_t count) {
      take.places.resize(count);
      take.record.layers.resize(count);
    });
    const auto count = [](const StoredTake& t) { return t.places.size(); };
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      const auto kind = checked<LayerKind>(v, static_cast<std::uint64_t>(LayerKind::text));
      if (kind < LayerKind::coefficients) throw_damaged();
      t.record.layers[i].kind = kind;
    });
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.layers[i].base = checked<int>(v, i);
    });
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.layers[i].limit_mm = static_cast<double>(v) / 1000.0;
    });
    std::size_t offset = 0;
    columns(count, [&](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.places[i].offset = offset;
      t.places[i].size = checked<std::size_t>(v, std::uint64_t{1} << 32);
      offset += t.places[i].size;
    });
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.places[i].compressed = checked<bool>(v, 1);
    });
    for (StoredTake& take : takes()) {
      for (LayerPlace& place : take.places) {
        std::ranges::copy(reader_.raw(place.digest.size()), place.digest.begin());
      }
      take.record.info.payload_bytes = size_of_layers(take);
    }
  }

  void unpack_spent() {
    counts(TakeBlockLimits::parts,
           [](StoredTake& take, std::size_t count) { take.record.spent.resize(count); });
    const auto count = [](const StoredTake& t) { return t.record.spent.size(); };
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.spent[i].first = part_name(v);
    });
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.spent[i].second = size_of_layer(t, i) + static_cast<std::uint64_t>(unfolded(v));
    });
  }

  void unpack_clips() {
    counts(1, [](StoredTake& take, std::size_t count) {
      if (count == 1) take.clip.emplace();
    });
    const auto count = [](const StoredTake& t) -> std::size_t { return t.clip ? 1 : 0; };
    columns(count, [](StoredTake& t, std::size_t, std::uint64_t v) {
      t.clip->group = static_cast<std::int64_t>(v);
    });
    columns(count, [](StoredTake& t, std::size_t, std::uint64_t v) {
      t.clip->bytes = size_of_layers(t) + static_cast<std::uint64_t>(unfolded(v));
    });
    for (StoredTake& take : takes()) {
      if (!take.clip) continue;
      for (const std::uint8_t byte : reader_.raw(sizeof take.clip->address))
        take.clip->address = take.clip->address << 8 | byte;
    }
  }

  void unpack_texts() {
    std::vector<std::size_t> digest_sizes;
    counts(Digest{}.size(), [&](StoredTake&, std::size_t count) { digest_sizes.push_back(count); });
    for (std::size_t i = 0; i < takes().size(); ++i)
      takes()[i].record.info.source_digest = hexadecimal(reader_.raw(digest_sizes[i]));
    std::array<std::vector<std::uint64_t>, 4> sizes;
    for (auto& column_of_sizes : sizes) column_of_sizes = reader_.numbers(takes().size());
    const bool compressed = checked<bool>(reader_.number(), 1);
    const std::span<const std::uint8_t> stored = reader_.rest();
    const Bytes decompressed = compressed ? decompress(stored, most_texts) : Bytes();
    ColumnReader texts(compressed ? std::span<const std::uint8_t>(decompressed) : stored);
    for (std::size_t text = 0; text < sizes.size(); ++text) {
      for (std::size_t i = 0; i < takes().size(); ++i) {
        const auto bytes = texts.raw(checked<std::size_t>(sizes[text][i], most_texts));
        texts_of(takes()[i].record.info)[text]->assign(bytes.begin(), bytes.end());
      }
    }
    if (!texts.rest().empty()) throw_damaged();
  }

  TakeBlock block_;
  ColumnReader reader_;
};

}  // namespace

std::int64_t micrometres(double millimetres) { return std::llround(millimetres * 1000.0); }

std::uint64_t part_number(const std::string& name) {
  const auto part = std::ranges::find(part_names(), name);
  assert(part != part_names().end());
  return static_cast<std::uint64_t>(part - part_names().begin());
}

std::string part_name(std::uint64_t number) {
  if (number >= part_names().size()) throw_damaged();
  return part_names()[number];
}

std::int64_t block_of(std::int64_t take) {
  return take / static_cast<std::int64_t>(TakeBlockLimits::takes);
}

const StoredTake* TakeBlock::find(std::int64_t take) const {
  const auto found = std::ranges::find_if(
      takes, [&](const StoredTake& candidate) { return id_of(candidate) == take; });
  return found == takes.end() ? nullptr : &*found;
}

std::int64_t TakeBlock::id_of(const StoredTake& take) const {
  return id * static_cast<std::int64_t>(TakeBlockLimits::takes) +
         static_cast<std::int64_t>(take.slot);
}

std::size_t TakeBlock::data_size() const {
  std::size_t size = 0;
  for (const StoredTake& take : takes) size += size_of_layers(take);
  return size;
}

Bytes pack_block(const TakeBlock& block) { return Packer(block).pack(); }

TakeBlock unpack_block(std::int64_t id, std::span<const std::uint8_t> bytes) {
  return Unpacker(id, bytes).unpack();
}

ShortDigest block_digest(std::int64_t id, std::span<const std::uint8_t> bytes) {
  Hasher hasher;
  hasher.add_number(id);
  hasher.add_bytes(bytes);
  return shortened(hasher.finish());
}

}  // namespace reprise

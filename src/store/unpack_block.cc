// A block of takes out of its bytes; nothing in them is believed.
#include <algorithm>
#include <bit>
#include <utility>

#include "reprise/error.h"
#include "store/block_columns.h"
#include "store/compression.h"
#include "store/unpack_clips.h"

namespace reprise {
namespace {

/// Names, subjects, descriptions and tags of a block together (bytes).
constexpr std::size_t most_texts = std::size_t{1} << 28;

/// Of an error or a limit: up to this, what was divided to be millimetres is the same number again
/// when it is packed.
constexpr std::uint64_t most_micrometres = std::uint64_t{1} << 50;
/// Of where an error is largest.
constexpr std::uint64_t most_joint = std::uint64_t{1} << 24;

class Unpacker {
 public:
  Unpacker(std::int64_t id, std::span<const std::uint8_t> bytes)
      : reader_(bytes), columns_(block_.takes, reader_) {
    block_.id = id;
  }

  TakeBlock unpack() {
    const std::uint64_t count = reader_.number();
    if (count > TakeBlockLimits::takes) throw_damaged_block();
    block_.takes.resize(count);
    unpack_numbers();
    unpack_errors();
    unpack_layers();
    unpack_spent();
    unpack_clips(takes(), reader_);
    unpack_texts();
    return std::move(block_);
  }

 private:
  std::vector<StoredTake>& takes() { return block_.takes; }

  static double millimetres(std::uint64_t micrometres) {
    return checked<double>(micrometres, most_micrometres) / 1000.0;
  }

  void unpack_numbers() {
    std::size_t next = 0;
    columns_.column([&](StoredTake& take, std::uint64_t gap) {
      take.slot = next + checked<std::size_t>(gap, TakeBlockLimits::takes);
      if (take.slot >= TakeBlockLimits::takes) throw_damaged_block();
      next = take.slot + 1;
      take.record.info.id = block_.id_of(take);
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) {
      t.record.proportions = checked<std::int64_t>(v, most_id);
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) {
      t.record.space = checked<std::int64_t>(v, most_id);
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.frames = checked<long>(v, most_frames);
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.fidelity.tier = checked<FidelityTier>(v, 255);
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.fidelity.limit_mm = std::bit_cast<double>(v);
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.fidelity.limit_deg = std::bit_cast<double>(v);
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) {
      t.record.info.text_bytes = checked<std::uint64_t>(v, most_frames) *
                                 static_cast<std::uint64_t>(std::max(1L, t.record.info.frames));
    });
    columns_.column([&](StoredTake& t, std::uint64_t v) { t.record.info.text_bytes += v; });
  }

  void unpack_errors() {
    const auto error = [&](double PositionErrors::*member) {
      columns_.column([member](StoredTake& t, std::uint64_t v) {
        t.record.info.error_mm.*member = millimetres(v);
      });
    };
    error(&PositionErrors::mean);
    error(&PositionErrors::rms);
    error(&PositionErrors::p99);
    error(&PositionErrors::max);
    const auto turn = [&](double RotationErrors::*member) {
      columns_.column([member](StoredTake& t, std::uint64_t v) {
        t.record.info.rotation_deg.*member = millimetres(v);
      });
    };
    turn(&RotationErrors::mean);
    turn(&RotationErrors::p99);
    turn(&RotationErrors::max);
    for (const auto worst : {&TakeInfo::worst_place, &TakeInfo::worst_turn}) {
      columns_.column([worst](StoredTake& t, std::uint64_t v) {
        (t.record.info.*worst).joint = checked<int>(v, most_joint);
      });
      columns_.column([worst](StoredTake& t, std::uint64_t v) {
        (t.record.info.*worst).frame = checked<long>(v, most_frames);
      });
    }
    unpack_sketch(&TakeRecord::error_quantiles);
    unpack_sketch(&TakeRecord::turn_quantiles);
  }

  void unpack_sketch(Bytes TakeRecord::*sketch) {
    columns_.counts(TakeBlockLimits::quantiles, [sketch](StoredTake& take, std::size_t count) {
      (take.record.*sketch).resize(count);
    });
    const auto count = [sketch](const StoredTake& t) { return (t.record.*sketch).size(); };
    columns_.columns_by_place(count, [sketch](StoredTake& t, std::size_t q, std::uint64_t v) {
      Bytes& quantiles = t.record.*sketch;
      const int before = q == 0 ? 0 : quantiles[q - 1];
      quantiles[q] = static_cast<std::uint8_t>(before + static_cast<int>(v & 255));
    });
  }

  void unpack_layers() {
    columns_.counts(most_layers, [](StoredTake& take, std::size_t count) {
      take.places.resize(count);
      take.record.layers.resize(count);
    });
    const auto count = [](const StoredTake& t) { return t.places.size(); };
    columns_.columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      const auto kind = checked<LayerKind>(v, static_cast<std::uint64_t>(LayerKind::channels));
      if (kind < LayerKind::coefficients) throw_damaged_block();
      t.record.layers[i].kind = kind;
    });
    columns_.columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.layers[i].limit_mm = millimetres(v);
    });
    columns_.columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.layers[i].limit_deg = millimetres(v);
    });
    columns_.columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.places[i].size = checked<std::size_t>(v, std::uint64_t{1} << 32);
    });
    columns_.columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.places[i].compressed = checked<bool>(v, 1);
    });
    std::size_t offset = 0;
    for (StoredTake& take : takes()) {
      for (std::size_t i = 0; i < take.places.size(); ++i) {
        LayerPlace& place = take.places[i];
        place.offset = std::exchange(offset, offset + place.size);
        std::ranges::copy(reader_.raw(place.digest.size()), place.digest.begin());
        take.record.layers[i].digest = place.digest;
      }
      take.record.info.payload_bytes = size_of_layers(take);
    }
  }

  void unpack_spent() {
    columns_.counts(TakeBlockLimits::parts,
                    [](StoredTake& take, std::size_t count) { take.record.spent.resize(count); });
    const auto count = [](const StoredTake& t) { return t.record.spent.size(); };
    columns_.columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.spent[i].first = part_name(v);
    });
    columns_.columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.spent[i].second = size_of_layer(t, i) + static_cast<std::uint64_t>(unfolded(v));
    });
  }

  void unpack_texts() {
    std::vector<std::size_t> digest_sizes;
    columns_.counts(Digest{}.size(),
                    [&](StoredTake&, std::size_t count) { digest_sizes.push_back(count); });
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
    if (!texts.rest().empty()) throw_damaged_block();
  }

  TakeBlock block_;
  ColumnReader reader_;
  TakeColumns columns_;
};

}  // namespace

void throw_damaged_block() {
  throw Error(ErrorCode::damaged, "the archive is damaged: a block of takes makes no sense");
}

TakeBlock unpack_block(std::int64_t id, std::span<const std::uint8_t> bytes) {
  return Unpacker(id, bytes).unpack();
}

}  // namespace reprise

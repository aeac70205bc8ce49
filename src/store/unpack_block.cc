// A block of takes out of its bytes; nothing in them is believed.
#include <algorithm>
#include <bit>
#include <utility>

#include "reprise/error.h"
#include "store/block_columns.h"
#include "store/compression.h"
#include "store/number_columns.h"

namespace reprise {
namespace {

/// Names, subjects, descriptions and tags of a block together (bytes).
constexpr std::size_t most_texts = std::size_t{1} << 28;

constexpr std::int64_t most_id = std::int64_t{1} << 62;
constexpr std::int64_t most_step = std::int64_t{1} << 61;  ///< from a take to another
constexpr std::uint64_t most_frames = std::uint64_t{1} << 40;
/// Of an error or a limit: up to this, what was divided to be millimetres is the same number again
/// when it is packed.
constexpr std::uint64_t most_micrometres = std::uint64_t{1} << 50;

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the archive is damaged: a block of takes makes no sense");
}

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

  /// The same, with a column for each place in these lists, of the takes that have so many.
  template <class Count, class Put>
  void columns_by_place(const Count& count, const Put& put) {
    std::size_t most = 0;
    for (const StoredTake& take : takes()) most = std::max(most, count(take));
    for (std::size_t place = 0; place < most; ++place) {
      columns([&](const StoredTake& t) -> std::size_t { return place < count(t) ? 1 : 0; },
              [&](StoredTake& t, std::size_t, std::uint64_t v) { put(t, place, v); });
    }
  }

  /// A number that must be below a bound, to be used as one of another type.
  template <class Number>
  static Number checked(std::uint64_t value, std::uint64_t most) {
    if (value > most) throw_damaged();
    return static_cast<Number>(value);
  }

  static double millimetres(std::uint64_t micrometres) {
    return checked<double>(micrometres, most_micrometres) / 1000.0;
  }

  void unpack_numbers() {
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
        t.record.info.error_mm.*member = millimetres(v);
      });
    };
    error(&PositionErrors::mean);
    error(&PositionErrors::rms);
    error(&PositionErrors::p99);
    error(&PositionErrors::max);
    counts(TakeBlockLimits::quantiles,
           [](StoredTake& take, std::size_t count) { take.record.error_quantiles.resize(count); });
    const auto count = [](const StoredTake& t) { return t.record.error_quantiles.size(); };
    columns_by_place(count, [](StoredTake& t, std::size_t q, std::uint64_t v) {
      const int before = q == 0 ? 0 : t.record.error_quantiles[q - 1];
      t.record.error_quantiles[q] = static_cast<std::uint8_t>(before + static_cast<int>(v & 255));
    });
  }

  void unpack_layers() {
    counts(most_layers, [](StoredTake& take, std::size_t count) {
      take.places.resize(count);
      take.record.layers.resize(count);
    });
    const auto count = [](const StoredTake& t) { return t.places.size(); };
    columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      const auto kind = checked<LayerKind>(v, static_cast<std::uint64_t>(LayerKind::channels));
      if (kind < LayerKind::coefficients) throw_damaged();
      t.record.layers[i].kind = kind;
    });
    columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.layers[i].limit_mm = millimetres(v);
    });
    columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.places[i].size = checked<std::size_t>(v, std::uint64_t{1} << 32);
    });
    columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.places[i].compressed = checked<bool>(v, 1);
    });
    std::size_t offset = 0;
    for (StoredTake& take : takes()) {
      for (LayerPlace& place : take.places) {
        place.offset = std::exchange(offset, offset + place.size);
        std::ranges::copy(reader_.raw(place.digest.size()), place.digest.begin());
      }
      take.record.info.payload_bytes = size_of_layers(take);
    }
  }

  void unpack_spent() {
    counts(TakeBlockLimits::parts,
           [](StoredTake& take, std::size_t count) { take.record.spent.resize(count); });
    const auto count = [](const StoredTake& t) { return t.record.spent.size(); };
    columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.spent[i].first = part_name(v);
    });
    columns_by_place(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.record.spent[i].second = size_of_layer(t, i) + static_cast<std::uint64_t>(unfolded(v));
    });
  }

  void unpack_clips() {
    unpack_clip_counts();
    const auto count = [](const StoredTake& t) { return t.clips.size(); };
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      const auto kind = checked<ClipKind>(v, static_cast<std::uint64_t>(ClipKind::unique));
      if (kind < ClipKind::primary) throw_damaged();
      t.clips[i].kind = kind;
    });
    columns(count, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.clips[i].group = checked<std::int64_t>(v, most_id);
    });
    const auto but_one = [](const StoredTake& t) {
      return t.clips.empty() ? 0 : t.clips.size() - 1;
    };
    columns(but_one, [](StoredTake& t, std::size_t i, std::uint64_t v) {
      t.clips[i].frames = checked<long>(v, most_frames);
    });
    unpack_primaries();
    for (StoredTake& take : takes()) {
      long left = take.record.info.frames;
      for (StoredClip& clip : take.clips) {
        for (const std::uint8_t byte : reader_.raw(sizeof clip.address))
          clip.address = clip.address << 8 | byte;
        if (&clip == &take.clips.back()) clip.frames = left;
        if (clip.frames > left) throw_damaged();
        left -= clip.frames;
      }
    }
  }

  /// Each clip has an address further on, so that counts cannot claim more than there is.
  void unpack_clip_counts() {
    const std::vector<std::uint64_t> counts = reader_.numbers(takes().size());
    std::uint64_t left = reader_.left() / sizeof(StoredClip::address);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      takes()[i].clips.resize(checked<std::size_t>(counts[i], left));
      left -= counts[i];
    }
  }

  void unpack_primaries() {
    std::vector<std::pair<StoredTake*, StoredClip*>> repeated;
    for (StoredTake& take : takes()) {
      for (StoredClip& clip : take.clips) {
        if (clip.kind == ClipKind::repeated) repeated.emplace_back(&take, &clip);
      }
    }
    const std::vector<std::uint64_t> takes_of = reader_.numbers(repeated.size());
    const std::vector<std::uint64_t> indices = reader_.numbers(repeated.size());
    for (std::size_t i = 0; i < repeated.size(); ++i) {
      const std::int64_t step = unfolded(takes_of[i]);
      if (step > most_step || step < -most_step) throw_damaged();
      repeated[i].second->primary = {repeated[i].first->record.info.id + step,
                                     checked<std::size_t>(indices[i], most_frames)};
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

TakeBlock unpack_block(std::int64_t id, std::span<const std::uint8_t> bytes) {
  return Unpacker(id, bytes).unpack();
}

}  // namespace reprise

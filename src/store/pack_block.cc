// A block of takes into bytes, column by column.
#include <algorithm>
#include <bit>
#include <functional>

#include "store/block_columns.h"
#include "store/compression.h"
#include "store/number_columns.h"

namespace reprise {
namespace {

std::int64_t difference(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::int64_t>(a - b);
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

  /// The same, with a column for each place in these lists, of the takes that have so many.
  void columns_by_place(const std::function<std::size_t(const StoredTake&)>& count,
                        const std::function<std::uint64_t(const StoredTake&, std::size_t)>& value) {
    std::size_t most = 0;
    for (const StoredTake& take : takes_) most = std::max(most, count(take));
    for (std::size_t place = 0; place < most; ++place) {
      columns([&](const StoredTake& t) -> std::size_t { return place < count(t) ? 1 : 0; },
              [&](const StoredTake& t, std::size_t) { return value(t, place); });
    }
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
    column([](const StoredTake& t) {
      return std::bit_cast<std::uint64_t>(t.record.info.fidelity.limit_deg);
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
    const auto turn = [&](double RotationErrors::*member) {
      column([member](const StoredTake& t) {
        return static_cast<std::uint64_t>(micrometres(t.record.info.rotation_deg.*member));
      });
    };
    turn(&RotationErrors::mean);
    turn(&RotationErrors::p99);
    turn(&RotationErrors::max);
    for (const auto worst : {&TakeInfo::worst_place, &TakeInfo::worst_turn}) {
      column([worst](const StoredTake& t) {
        return static_cast<std::uint64_t>((t.record.info.*worst).joint);
      });
      column([worst](const StoredTake& t) {
        return static_cast<std::uint64_t>((t.record.info.*worst).frame);
      });
    }
    pack_sketch(&TakeRecord::error_quantiles);
    pack_sketch(&TakeRecord::turn_quantiles);
  }

  void pack_sketch(Bytes TakeRecord::*sketch) {
    const auto size = [sketch](const StoredTake& t) { return (t.record.*sketch).size(); };
    column(size);
    // Quantiles rise.
    columns_by_place(size, [sketch](const StoredTake& t, std::size_t q) {
      const Bytes& quantiles = t.record.*sketch;
      const int before = q == 0 ? 0 : quantiles[q - 1];
      return static_cast<std::uint64_t>((quantiles[q] - before) & 255);
    });
  }

  void pack_layers() {
    const auto count = [](const StoredTake& t) { return t.places.size(); };
    column(count);
    const auto layer = [](const StoredTake& t, std::size_t i) -> const LayerRecord& {
      return t.record.layers[i];
    };
    columns_by_place(count, [&](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(layer(t, i).kind);
    });
    columns_by_place(count, [&](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(micrometres(layer(t, i).limit_mm));
    });
    columns_by_place(count, [&](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(micrometres(layer(t, i).limit_deg));
    });
    columns_by_place(count, size_of_layer);
    columns_by_place(count, [](const StoredTake& t, std::size_t i) -> std::uint64_t {
      return t.places[i].compressed ? 1 : 0;
    });
    for (const StoredTake& take : takes_) {
      for (const LayerPlace& place : take.places) writer_.raw(place.digest);
    }
  }

  void pack_spent() {
    const auto count = [](const StoredTake& t) { return t.record.spent.size(); };
    column(count);
    columns_by_place(count, [](const StoredTake& t, std::size_t i) {
      return part_number(t.record.spent[i].first);
    });
    // Often a part is a layer.
    columns_by_place(count, [](const StoredTake& t, std::size_t i) {
      return folded(difference(t.record.spent[i].second, size_of_layer(t, i)));
    });
  }

  void pack_clips() {
    const auto count = [](const StoredTake& t) { return t.clips.size(); };
    column(count);
    columns(count, [](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(t.clips[i].kind);
    });
    columns(count, [](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(t.clips[i].group);
    });
    // The last one ends where the take does.
    const auto but_one = [](const StoredTake& t) {
      return t.clips.empty() ? 0 : t.clips.size() - 1;
    };
    columns(but_one, [](const StoredTake& t, std::size_t i) {
      return static_cast<std::uint64_t>(t.clips[i].frames);
    });
    pack_primaries();
    for (const StoredTake& take : takes_) {
      for (const StoredClip& clip : take.clips) writer_.raw(address_bytes(clip.address));
    }
  }

  void pack_primaries() {
    std::vector<std::uint64_t> takes, indices;
    for (const StoredTake& take : takes_) {
      for (const StoredClip& clip : take.clips) {
        if (clip.kind != ClipKind::repeated) continue;
        takes.push_back(folded(clip.primary.take - take.record.info.id));
        indices.push_back(clip.primary.index);
      }
    }
    writer_.numbers(takes);
    writer_.numbers(indices);
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

}  // namespace

Bytes pack_block(const TakeBlock& block) { return Packer(block).pack(); }

}  // namespace reprise

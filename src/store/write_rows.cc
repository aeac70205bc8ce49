// Rows that come into the archive, and rows that are taken out of it.
#include <algorithm>
#include <cassert>

#include "store/compression.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

Digest content_sum(const Database& database) {
  Statement statement(database, "SELECT value FROM meta WHERE key='content'");
  Digest sum{};
  if (statement.step()) {
    const Bytes bytes = statement.bytes();
    if (bytes.size() == sum.size()) std::copy(bytes.begin(), bytes.end(), sum.begin());
  }
  return sum;
}

void store_content_sum(const Database& database, const Digest& sum) {
  Statement(database, "UPDATE meta SET value=? WHERE key='content'").bind(sum).run();
}

/// A layer as it is stored: most are coded as densely as can be already.
Bytes stored_form(const LayerRecord& layer, LayerPlace& place) {
  Bytes frame = compress(layer.data, false);
  place.digest = shortened(digest_of(layer.data));
  place.compressed = frame.size() < layer.data.size();
  Bytes stored = place.compressed ? std::move(frame) : layer.data;
  place.size = stored.size();
  return stored;
}

/// Clips that follow one another and cover a take.
[[maybe_unused]] bool cover(const TakeRecord& take, std::span<const ClipRecord> clips) {
  long at = 0;
  for (const ClipRecord& clip : clips) {
    if (clip.first_frame != at) return false;
    at += clip.frames;
  }
  return clips.empty() || at == take.info.frames;
}

}  // namespace

std::int64_t ArchiveStore::add_skeleton(const SkeletonRecord& record) {
  impl_->require_transaction();
  impl_
      ->prepare(
          "INSERT INTO skeletons(structure, format, joints, channels, root, digest) "
          "VALUES(?,?,?,?,?,?)")
      .bind(record.structure)
      .bind(std::int64_t{static_cast<int>(record.format)})
      .bind(static_cast<std::int64_t>(record.joints))
      .bind(static_cast<std::int64_t>(record.channels))
      .bind(record.root)
      .bind(row_digest(record))
      .run();
  return impl_->database->last_row();
}

std::int64_t ArchiveStore::add_proportions(const ProportionsRecord& record) {
  impl_->require_transaction();
  // What the first actor's text holds is not stored again for the others.
  std::string prefix;
  Statement first = impl_->prepare("SELECT count(*) FROM proportions WHERE skeleton=?");
  first.bind(record.skeleton);
  if (first.step() && first.integer() > 0)
    prefix = reference_proportions(record.skeleton).source_text;
  const Digest identity = proportions_identity(record);
  Bytes text = compress(bytes_of(record.source_text), true, bytes_of(prefix));
  impl_
      ->prepare(
          "INSERT INTO proportions(skeleton, identity, unit_mm, up, frame_rate, assumed, asf_name, "
          "layout, text, "
          "digest) VALUES(?,?,?,?,?,?,?,?,?,?)")
      .bind(record.skeleton)
      .bind(identity)
      .bind(record.millimetres_per_unit)
      .bind(std::int64_t{static_cast<int>(record.up)})
      .bind(record.frame_rate)
      .bind(assumed_bits(record))
      .bind(record.asf_name)
      .bind(compress(record.layout, true))
      .bind(text)
      .bind(shortened(identity))
      .run();
  return impl_->database->last_row();
}

void ArchiveStore::hold_proportions(std::int64_t id) { impl_->held.insert(id); }

std::int64_t ArchiveStore::add_space(const SpaceRecord& record) {
  impl_->require_transaction();
  Digest base{};
  if (record.base != 0) base = digest_of_space(record.base);
  const Digest digest = space_digest(skeleton(record.skeleton).structure, base, record.data);
  impl_->prepare("INSERT INTO spaces(skeleton, base, data, digest) VALUES(?,?,?,?)")
      .bind(record.skeleton)
      .bind(record.base)
      .bind(compress(record.data, false))
      .bind(digest)
      .run();
  return impl_->database->last_row();
}

std::int64_t ArchiveStore::add_take(const TakeRecord& take, std::span<const ClipRecord> clips) {
  impl_->require_transaction();
  assert(!take.layers.empty() && take.layers.size() <= most_layers);
  assert(take.error_quantiles.size() <= TakeBlockLimits::quantiles);
  assert(take.spent.size() <= TakeBlockLimits::parts);
  Impl::OpenBlock& open = impl_->open_block();
  StoredTake stored;
  stored.slot = open.block->takes.empty() ? 0 : open.block->takes.back().slot + 1;
  stored.record = take;
  for (LayerRecord& layer : stored.record.layers) {
    LayerPlace place;
    place.offset = open.data.size();
    const Bytes bytes = stored_form(layer, place);
    open.data.insert(open.data.end(), bytes.begin(), bytes.end());
    layer.data.clear();
    layer.digest = place.digest;
    stored.places.push_back(place);
    stored.record.info.payload_bytes += place.size;
  }
  assert(cover(take, clips));
  const std::int64_t id = open.block->id_of(stored);
  stored.record.info.id = id;
  stored.clips = stored_clips(id, clips);
  if (std::ranges::any_of(clips, [](const ClipRecord& c) { return c.kind == ClipKind::repeated; }))
    impl_->links.reset();
  impl_->add_keys(id, keys_of(take.info, clips));
  open.block->takes.push_back(std::move(stored));
  Digest sum = content_sum(*impl_->database);
  add_to_sum(sum, content_of(id));
  store_content_sum(*impl_->database, sum);
  return id;
}

void ArchiveStore::change_clips(const std::map<std::int64_t, std::vector<ClipRecord>>& changes) {
  impl_->flush();
  Digest sum = content_sum(*impl_->database);
  for (const auto& [take, clips] : changes) subtract_from_sum(sum, content_of(take));
  // The takes of a block follow one another in the map: each block is written once.
  for (auto next = changes.begin(); next != changes.end();) {
    const auto found = impl_->block(block_of(next->first));
    TakeBlock block = *found;
    for (; next != changes.end() && block_of(next->first) == block.id; ++next) {
      const auto at = std::ranges::find(block.takes, next->first,
                                        [&](const StoredTake& take) { return block.id_of(take); });
      std::vector<StoredClip> clips = stored_clips(next->first, next->second);
      assert(std::ranges::equal(clips, at->clips, {}, &StoredClip::address, &StoredClip::address));
      at->clips = std::move(clips);
    }
    impl_->write_block(block, impl_->block_data(block.id));
  }
  for (const auto& [take, clips] : changes) add_to_sum(sum, content_of(take));
  store_content_sum(*impl_->database, sum);
}

void ArchiveStore::set_clips(const std::map<std::int64_t, std::vector<ClipRecord>>& clips) {
  impl_->require_transaction();
  impl_->links.reset();
  if (!clips.empty()) change_clips(clips);
}

void ArchiveStore::remove_take(std::int64_t id) {
  impl_->require_transaction();
  impl_->flush();
  unlink_take(id);
  const auto found = impl_->block(block_of(id));
  const StoredTake* stored = found ? found->find(id) : nullptr;
  if (stored == nullptr) {
    throw Error(ErrorCode::damaged,
                "the archive is damaged: there is no take " + std::to_string(id));
  }
  Digest sum = content_sum(*impl_->database);
  subtract_from_sum(sum, content_of(id));
  store_content_sum(*impl_->database, sum);
  impl_->remove_keys(id, keys_of(stored->record.info, clips_of(id, *stored)));
  impl_->vacated.insert(stored->record.proportions);
  Bytes data = impl_->block_data(found->id);
  for (auto place = stored->places.rbegin(); place != stored->places.rend(); ++place) {
    const auto begin = data.begin() + static_cast<std::ptrdiff_t>(place->offset);
    data.erase(begin, begin + static_cast<std::ptrdiff_t>(place->size));
  }
  TakeBlock left = *found;
  std::erase_if(left.takes, [&](const StoredTake& take) { return left.id_of(take) == id; });
  impl_->write_block(left, data);
}

void ArchiveStore::Impl::remove_vacated() {
  if (vacated.empty()) return;
  // One look at all takes for all that were removed.
  std::set<std::int64_t> used = held;
  for_each_block([&](const TakeBlock& block) {
    for (const StoredTake& take : block.takes) used.insert(take.record.proportions);
  });
  for (const std::int64_t id : vacated) {
    if (used.contains(id)) continue;
    Statement row = prepare("SELECT skeleton FROM proportions WHERE id=?");
    row.bind(id);
    if (row.step()) remove_proportions(id, row.integer(), used);
  }
  vacated.clear();
}

void ArchiveStore::Impl::remove_proportions(std::int64_t id, std::int64_t skeleton,
                                            const std::set<std::int64_t>& used) {
  Statement row = prepare("SELECT id FROM proportions WHERE skeleton=? ORDER BY id");
  row.bind(skeleton);
  std::vector<std::int64_t> all;
  while (row.step()) all.push_back(row.integer());
  const bool skeleton_used =
      std::ranges::any_of(all, [&](std::int64_t other) { return used.contains(other); });
  if (!skeleton_used) {
    prepare("DELETE FROM spaces WHERE skeleton=?").bind(skeleton).run();
    prepare("DELETE FROM proportions WHERE skeleton=?").bind(skeleton).run();
    prepare("DELETE FROM skeletons WHERE id=?").bind(skeleton).run();
  } else if (id != all.front()) {
    // A skeleton keeps its axes and the proportions that they are for.
    prepare("DELETE FROM proportions WHERE id=?").bind(id).run();
  }
}

}  // namespace reprise

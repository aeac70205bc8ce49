// Blocks of takes as rows, and the keys that lead to them.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "store/block_columns.h"
#include "store/compression.h"
#include "store/key_rows.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

/// Blocks that are kept decoded.
constexpr std::size_t most_known_blocks = 16;
/// Takes of blocks beyond this have ids that keys cannot lead to.
constexpr std::int64_t most_block_id =
    (std::int64_t{1} << key_target_bits) / static_cast<std::int64_t>(TakeBlockLimits::takes) - 1;

[[noreturn]] void throw_damaged(std::int64_t id) {
  throw Error(ErrorCode::damaged, "the archive is damaged: block " + std::to_string(id) +
                                      " of takes is not as it was written");
}

bool has_room(const TakeBlock& block) {
  return block.data_size() < TakeBlockLimits::open_bytes &&
         (block.takes.empty() || block.takes.back().slot + 1 < TakeBlockLimits::takes);
}

}  // namespace

std::shared_ptr<const TakeBlock> ArchiveStore::Impl::block(std::int64_t id) const {
  if (open && open->block->id == id) return open->block;
  Statement row = prepare("SELECT digest, takes FROM blocks WHERE id=?");
  row.bind(id);
  if (!row.step()) return nullptr;
  if (id <= 0 || id > most_block_id) throw_damaged(id);
  Bytes digest = row.bytes();
  const auto before = known.find(id);
  if (before != known.end() && before->second.digest == digest) return before->second.block;
  const Bytes takes = row.bytes();
  if (!std::ranges::equal(digest, block_digest(id, takes))) throw_damaged(id);
  auto block = std::make_shared<const TakeBlock>(unpack_block(id, takes));
  if (known.size() >= most_known_blocks) known.clear();
  known[id] = {std::move(digest), block};
  return block;
}

void ArchiveStore::Impl::for_each_block(const std::function<void(const TakeBlock&)>& visit) const {
  bool open_seen = false;
  Statement ids = prepare("SELECT id FROM blocks ORDER BY id");
  while (ids.step()) {
    const std::int64_t id = ids.integer();
    const auto found = block(id);
    if (!found) throw_damaged(id);
    open_seen = open_seen || (open && open->block->id == id);
    visit(*found);
  }
  if (open && !open_seen) visit(*open->block);
}

Bytes ArchiveStore::Impl::block_data(std::int64_t id) const {
  Statement row = prepare("SELECT data FROM blocks WHERE id=?");
  row.bind(id);
  if (!row.step()) throw_damaged(id);
  return row.bytes();
}

Bytes ArchiveStore::Impl::stored_layer(const TakeBlock& block, const LayerPlace& place) const {
  if (open && open->block->id == block.id) {
    const auto begin = open->data.begin() + static_cast<std::ptrdiff_t>(place.offset);
    return {begin, begin + static_cast<std::ptrdiff_t>(place.size)};
  }
  return read_part(*database, {"blocks", "data", block.id}, place.offset, place.size);
}

ArchiveStore::Impl::OpenBlock& ArchiveStore::Impl::open_block() {
  if (open && has_room(*open->block)) return *open;
  flush();
  Statement last = prepare("SELECT coalesce(max(id), 0) FROM blocks");
  last.step();
  const std::int64_t id = last.integer();
  if (const auto newest = block(id); newest && has_room(*newest)) {
    open = OpenBlock{std::make_shared<TakeBlock>(*newest), block_data(id)};
    if (open->data.size() != newest->data_size()) throw_damaged(id);
  } else {
    if (id >= most_block_id) throw Error(ErrorCode::limit, "the archive can take no more takes");
    open = OpenBlock{std::make_shared<TakeBlock>(TakeBlock{id + 1, {}}), {}};
  }
  return *open;
}

void ArchiveStore::Impl::write_block(const TakeBlock& block, const Bytes& data) {
  write_terms(block);
  // Replacing a row takes new pages before it frees those of the old one, which then stay in the
  // file unused.
  prepare("DELETE FROM blocks WHERE id=?").bind(block.id).run();
  if (block.takes.empty()) return;
  const Bytes takes = pack_block(block);
  prepare("INSERT INTO blocks(id, takes, digest, data) VALUES(?,?,?,?)")
      .bind(block.id)
      .bind(takes)
      .bind(block_digest(block.id, takes))
      .bind(data)
      .run();
}

void ArchiveStore::Impl::flush() {
  if (!open) return;
  const OpenBlock closing = std::move(*open);
  open.reset();
  write_block(*closing.block, closing.data);
}

void ArchiveStore::Impl::write_terms(const TakeBlock& block) {
  const WordSplitter splitter(*database);
  const auto before = this->block(block.id);
  const TermKeys old_keys = before ? terms_of(*before, splitter) : TermKeys();
  const TermKeys new_keys = terms_of(block, splitter);
  const KeyRows rows(*database, KeyTarget::block);
  for (const std::int64_t key : old_keys) {
    if (!new_keys.contains(key)) rows.remove(key, block.id);
  }
  for (const std::int64_t key : new_keys) {
    if (!old_keys.contains(key)) rows.add(key, block.id);
  }
}

std::vector<std::int64_t> ArchiveStore::Impl::blocks_with(const TermKeys& terms) const {
  const KeyRows rows(*database, KeyTarget::block);
  std::vector<std::int64_t> ids;
  for (const std::int64_t key : terms) {
    const std::vector<std::int64_t> with = rows.find(key, key);
    if (key == *terms.begin()) ids = with;
    std::erase_if(ids, [&](std::int64_t id) { return !std::ranges::binary_search(with, id); });
  }
  if (open && !std::ranges::binary_search(ids, open->block->id)) ids.push_back(open->block->id);
  return ids;
}

void ArchiveStore::Impl::add_keys(std::int64_t take, const std::set<std::int64_t>& keys) {
  for (const std::int64_t key : keys) KeyRows(*database, KeyTarget::take).add(key, take);
}

void ArchiveStore::Impl::remove_keys(std::int64_t take, const std::set<std::int64_t>& keys) {
  for (const std::int64_t key : keys) KeyRows(*database, KeyTarget::take).remove(key, take);
}

std::vector<std::int64_t> ArchiveStore::Impl::takes_with_keys(std::int64_t first,
                                                              std::int64_t last) const {
  return KeyRows(*database, KeyTarget::take).find(first, last);
}

std::int64_t key_of_address(std::uint64_t address) {
  return static_cast<std::int64_t>(address >> (64 - key_bits));
}

std::int64_t key_of_name(const std::string& name) {
  std::uint64_t address = 0;
  for (const std::uint8_t byte : shortened(digest_of(name))) address = address << 8 | byte;
  return key_of_address(address);
}

std::string leaf_of(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? name : name.substr(slash + 1);
}

std::set<std::int64_t> keys_of(const TakeInfo& take, std::span<const ClipRecord> clips) {
  std::set<std::int64_t> keys = {key_of_name(leaf_of(take.name)), key_of_name(take.name)};
  for (const ClipRecord& clip : clips) keys.insert(key_of_address(clip.id));
  return keys;
}

std::vector<ClipRecord> clips_of(std::int64_t take, const StoredTake& stored) {
  std::vector<ClipRecord> clips;
  const auto bytes = static_cast<double>(size_of_layers(stored));
  const auto frames = static_cast<double>(std::max(1L, stored.record.info.frames));
  // Rounded where clips meet, so that they add up.
  const auto bytes_before = [&](long frame) {
    return static_cast<std::uint64_t>(std::floor(bytes * (static_cast<double>(frame) / frames)));
  };
  long first = 0;
  for (const StoredClip& part : stored.clips) {
    ClipRecord clip;
    clip.id = part.address;
    clip.take = take;
    clip.kind = part.kind;
    clip.group = part.group;
    clip.first_frame = first;
    clip.frames = part.frames;
    clip.primary_place = part.primary;
    clip.bytes = bytes_before(first + part.frames) - bytes_before(first);
    first += part.frames;
    clips.push_back(clip);
  }
  return clips;
}

std::vector<StoredClip> stored_clips(std::int64_t take, std::span<const ClipRecord> clips) {
  std::vector<StoredClip> stored;
  for (const ClipRecord& clip : clips) {
    StoredClip part{clip.id, clip.kind, clip.group, clip.frames, {}};
    if (clip.kind == ClipKind::repeated) {
      part.primary = clip.primary_place;
      if (part.primary.take == 0) part.primary.take = take;
    }
    stored.push_back(part);
  }
  return stored;
}

}  // namespace reprise

// What the parts of ArchiveStore share.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "store/archive_store.h"
#include "store/database.h"
#include "store/digest.h"
#include "store/row_digests.h"
#include "store/take_block.h"
#include "store/terms.h"
#include "store/writer_lock.h"

namespace reprise {

struct ArchiveStore::Impl {
  std::optional<WriterLock> lock;  // let go last
  std::optional<Database> database;
  bool writing = false;
  WaitNotice waiting;
  bool in_transaction = false;
  int snapshots = 0;    ///< that live, one within another
  bool broken = false;  ///< a commit failed: nothing more is written

  /// The block that takes are being added to, not written yet.
  struct OpenBlock {
    std::shared_ptr<TakeBlock> block;
    Bytes data;
  };
  std::optional<OpenBlock> open;
  /// Of each primary clip the takes that repeat it, where they had to be known in this transaction.
  std::optional<std::map<ClipPlace, std::set<std::int64_t>>> links;
  /// Proportions of takes that were removed in this transaction.
  std::set<std::int64_t> vacated;
  std::set<std::int64_t> held;  ///< proportions that takes may come for yet
  struct KnownBlock {
    Bytes digest;
    std::shared_ptr<const TakeBlock> block;
  };
  /// Blocks as they were read last; good for as long as the row has the same digest.
  mutable std::map<std::int64_t, KnownBlock> known;

  Statement prepare(std::string_view sql) const { return Statement(*database, sql); }
  void require_transaction() const;

  // Blocks (block_rows.cc). Errors: damaged.
  std::shared_ptr<const TakeBlock> block(std::int64_t id) const;  ///< null: there is none
  void for_each_block(const std::function<void(const TakeBlock&)>& visit) const;
  /// The coded motion of all takes of a block that is not the open one.
  Bytes block_data(std::int64_t id) const;
  /// A layer's bytes as they are stored.
  Bytes stored_layer(const TakeBlock& block, const LayerPlace& place) const;
  /// The block that the next take goes to, with room for it.
  OpenBlock& open_block();
  void write_block(const TakeBlock& block, const Bytes& data);
  void flush();  ///< writes the open block
  /// Makes the index of terms say what a block has that is about to be written.
  void write_terms(const TakeBlock& block);
  /// Blocks that have all of these terms, one at least: those and maybe others.
  std::vector<std::int64_t> blocks_with(const TermKeys& terms) const;
  /// Takes out the proportions, spaces and skeletons that only removed takes needed.
  void remove_vacated();
  void remove_proportions(std::int64_t id, std::int64_t skeleton,
                          const std::set<std::int64_t>& used);

  // Keys (block_rows.cc).
  void add_keys(std::int64_t take, const std::set<std::int64_t>& keys);
  void remove_keys(std::int64_t take, const std::set<std::int64_t>& keys);
  /// Takes that have one of the keys from `first` to `last`: those that are looked for, and maybe
  /// others.
  std::vector<std::int64_t> takes_with_keys(std::int64_t first, std::int64_t last) const;
};

/// Keys are the first 24 bits of digests and addresses.
std::int64_t key_of_address(std::uint64_t address);
std::int64_t key_of_name(const std::string& name);
/// Of a take: its leaf, its whole name, and all its clips.
std::set<std::int64_t> keys_of(const TakeInfo& take, std::span<const ClipRecord> clips);

/// The clips of a take, without the addresses of their primaries; and back.
std::vector<ClipRecord> clips_of(std::int64_t take, const StoredTake& stored);
std::vector<StoredClip> stored_clips(std::int64_t take, std::span<const ClipRecord> clips);

/// The last component of a name: "c" of "a/b/c".
std::string leaf_of(const std::string& name);

}  // namespace reprise

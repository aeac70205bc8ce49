// Takes, their layers and their clips out of the archive, each held against its digest.
#include <algorithm>
#include <cassert>
#include <tuple>

#include "store/compression.h"
#include "store/full_text.h"
#include "store/store_impl.h"

namespace reprise {
namespace {

/// Largest layer that is taken out of an archive (bytes).
constexpr std::size_t most_layer_bytes = std::size_t{1} << 30;

[[noreturn]] void throw_damaged(const std::string& what) {
  throw Error(ErrorCode::damaged, "the archive is damaged: " + what + " is not as it was written");
}

/// What a take shares with others of its proportions.
struct SharedFacts {
  std::int64_t skeleton = 0;
  double frame_rate = 0;
  bool frame_rate_assumed = false;
  double unit_mm = 0;
  bool unit_assumed = false;
  UpAxis up = UpAxis::y;
  bool up_assumed = false;
  MotionFormat format = MotionFormat::bvh;
  std::uint64_t channels = 0;
};
using SharedFactsById = std::map<std::int64_t, SharedFacts>;

/// These rows have digests of their own, which are held against what is decoded with them.
SharedFacts read_shared_facts(const Database& database, std::int64_t proportions) {
  Statement row(
      database,
      "SELECT skeleton, unit_mm, up, frame_rate, assumed, format, channels FROM proportions JOIN "
      "skeletons ON skeletons.id=proportions.skeleton WHERE proportions.id=?");
  row.bind(proportions);
  if (!row.step()) throw_damaged("the proportions " + std::to_string(proportions));
  SharedFacts facts;
  facts.skeleton = row.integer();
  facts.unit_mm = row.real();
  const std::optional<UpAxis> up = up_of_row(row.integer());
  if (!up) throw_damaged("an axis that points up");
  facts.up = *up;
  facts.frame_rate = row.real();
  if (!is_frame_rate(facts.frame_rate)) throw_damaged("a frame rate");
  const std::int64_t assumed = row.integer();
  facts.frame_rate_assumed = (assumed & assumed_frame_rate) != 0;
  facts.unit_assumed = (assumed & assumed_unit) != 0;
  facts.up_assumed = (assumed & assumed_up) != 0;
  facts.format = static_cast<MotionFormat>(row.integer());
  facts.channels = static_cast<std::uint64_t>(row.integer());
  return facts;
}

/// A stored take with what the rows say that it refers to. `known` are those read already.
TakeRecord whole_record(const Database& database, const StoredTake& stored,
                        SharedFactsById& known) {
  TakeRecord record = stored.record;
  const auto found = known.find(record.proportions);
  const SharedFacts& facts =
      found != known.end()
          ? found->second
          : known.emplace(record.proportions, read_shared_facts(database, record.proportions))
                .first->second;
  TakeInfo& info = record.info;
  info.skeleton = facts.skeleton;
  info.frame_rate = facts.frame_rate;
  info.frame_rate_assumed = facts.frame_rate_assumed;
  info.unit_mm = facts.unit_mm;
  info.unit_assumed = facts.unit_assumed;
  info.up = facts.up;
  info.up_assumed = facts.up_assumed;
  info.format = facts.format;
  info.raw_bytes = 4 * facts.channels * static_cast<std::uint64_t>(info.frames);
  return record;
}

/// Whether a take has this name, or one that ends in it after a slash.
bool has_name_or_end(const TakeInfo& info, const std::string& tail) {
  return info.name == tail || info.name.ends_with("/" + tail);
}

}  // namespace

void ArchiveStore::for_each_take(const std::function<void(const TakeRecord&)>& visit) const {
  SharedFactsById known;
  impl_->for_each_block([&](const TakeBlock& block) {
    for (const StoredTake& stored : block.takes)
      visit(whole_record(*impl_->database, stored, known));
  });
}

void ArchiveStore::for_each_take_with(const std::set<std::int64_t>& terms,
                                      const std::function<void(const TakeRecord&)>& visit) const {
  SharedFactsById known;
  for (const std::int64_t id : impl_->blocks_with(terms)) {
    const auto block = impl_->block(id);
    if (!block) throw_damaged("the index of terms");
    for (const StoredTake& stored : block->takes)
      visit(whole_record(*impl_->database, stored, known));
  }
}

std::vector<TakeRecord> ArchiveStore::takes_named(const std::string& tail, bool whole) const {
  std::vector<TakeRecord> records;
  const std::int64_t key = key_of_name(whole ? tail : leaf_of(tail));
  SharedFactsById known;
  for (const std::int64_t id : impl_->takes_with_keys(key, key)) {
    const auto block = impl_->block(block_of(id));
    const StoredTake* stored = block ? block->find(id) : nullptr;
    if (stored == nullptr) throw_damaged("the index of names");
    const TakeInfo& info = stored->record.info;
    if (whole ? info.name == tail : has_name_or_end(info, tail))
      records.push_back(whole_record(*impl_->database, *stored, known));
  }
  return records;
}

std::optional<TakeRecord> ArchiveStore::find_take(const std::string& name) const {
  std::vector<TakeRecord> found = takes_named(name, true);
  if (found.size() > 1) throw_damaged("the index of names");
  return found.empty() ? std::nullopt : std::optional(std::move(found[0]));
}

TakeRecord ArchiveStore::take(std::int64_t id) const {
  const auto block = impl_->block(block_of(id));
  const StoredTake* stored = block ? block->find(id) : nullptr;
  if (stored == nullptr) throw_damaged("take " + std::to_string(id));
  SharedFactsById known;
  return whole_record(*impl_->database, *stored, known);
}

Bytes ArchiveStore::layer(std::int64_t take, std::size_t index) const {
  const std::string what = "the motion of take " + std::to_string(take);
  const auto block = impl_->block(block_of(take));
  const StoredTake* stored = block ? block->find(take) : nullptr;
  if (stored == nullptr || index >= stored->places.size()) throw_damaged(what);
  const LayerPlace& place = stored->places[index];
  Bytes data = impl_->stored_layer(*block, place);
  if (place.compressed) data = decompress(data, most_layer_bytes);
  if (place.digest != shortened(digest_of(data))) throw_damaged(what);
  return data;
}

std::vector<std::string> ArchiveStore::take_names_ending_in(const std::string& tail,
                                                            std::size_t most) const {
  std::vector<std::string> names;
  for (const TakeRecord& record : takes_named(tail, false)) names.push_back(record.info.name);
  std::ranges::sort(names);
  names.resize(std::min(names.size(), most));
  return names;
}

std::vector<TakeInfo> ArchiveStore::takes(const TakeFilter& filter) const {
  const WordSplitter splitter(*impl_->database);
  // A text without words says nothing that could be found.
  if (!filter.text.empty() && splitter.words(filter.text).empty()) return {};
  std::vector<TakeInfo> takes;
  const auto add_if_fitting = [&](const TakeRecord& record) {
    const TakeInfo& info = record.info;
    if (!filter.take.empty() && !has_name_or_end(info, filter.take)) return;
    if (!filter.subject.empty() && info.subject != filter.subject) return;
    if (filter.kind && !has_clip_of_kind(info.id, *filter.kind)) return;
    takes.push_back(info);
  };
  const TermKeys terms = terms_of(filter, splitter);
  if (!filter.take.empty()) {
    std::ranges::for_each(takes_named(filter.take, false), add_if_fitting);
  } else if (terms.empty()) {
    for_each_take(add_if_fitting);
  } else {
    for_each_take_with(terms, add_if_fitting);
  }
  std::ranges::sort(takes, {}, &TakeInfo::name);
  return filter.text.empty() ? takes : takes_with_words(*impl_->database, takes, filter.text);
}

bool ArchiveStore::has_clip_of_kind(std::int64_t take, ClipKind kind) const {
  const std::int64_t ids[] = {take};
  return std::ranges::any_of(clips(ids), [&](const ClipRecord& clip) { return clip.kind == kind; });
}

std::vector<ClipRecord> ArchiveStore::clips(std::span<const std::int64_t> takes) const {
  std::vector<ClipRecord> clips;
  for (const std::int64_t take : takes) {
    const auto block = impl_->block(block_of(take));
    const StoredTake* stored = block ? block->find(take) : nullptr;
    if (stored == nullptr) continue;
    for (ClipRecord& clip : clips_of(take, *stored)) {
      if (clip.kind == ClipKind::repeated) clip.primary = primary_of(clip).address;
      clips.push_back(clip);
    }
  }
  return clips;
}

std::vector<ClipRecord> ArchiveStore::clips_with_prefix(const std::string& hexadecimal) const {
  assert(!hexadecimal.empty() && hexadecimal.size() <= 16);
  std::uint64_t low = 0;
  for (const char c : hexadecimal) {
    low = low << 4 | std::string_view("0123456789abcdef").find(c);
  }
  const auto missing = 4 * (16 - static_cast<int>(hexadecimal.size()));
  low = missing < 64 ? low << missing : low;
  const std::uint64_t high = low + (missing > 0 ? (std::uint64_t{1} << missing) - 1 : 0);
  std::vector<ClipRecord> found;
  for (const std::int64_t take :
       impl_->takes_with_keys(key_of_address(low), key_of_address(high))) {
    const std::int64_t ids[] = {take};
    for (const ClipRecord& clip : clips(ids)) {
      if (clip.id >= low && clip.id <= high) found.push_back(clip);
    }
  }
  std::ranges::sort(found, {}, [](const ClipRecord& clip) {
    return std::tuple(clip.id, clip.take, clip.first_frame);
  });
  return found;
}

Digest ArchiveStore::content_of(std::int64_t id) const {
  const TakeRecord record = take(id);
  const std::int64_t ids[] = {id};
  const std::vector<ClipRecord> own = clips(ids);
  std::vector<Digest> layers;
  for (std::size_t i = 0; i < record.layers.size(); ++i) layers.push_back(digest_of(layer(id, i)));
  return take_content(record, proportions(record.proportions).identity,
                      digest_of_space(record.space), layers, own);
}

}  // namespace reprise

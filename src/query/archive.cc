// An archive opened for reading.
#include "reprise/archive.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "query/archive_impl.h"
#include "query/clip_info.h"
#include "query/error_sketch.h"
#include "query/take_decoder.h"
#include "reprise/error.h"
#include "store/digest.h"

namespace reprise {
namespace {

constexpr std::size_t least_id_digits = 4;
constexpr std::size_t id_digits = 16;
/// How many candidates an error about an ambiguous ID names.
constexpr std::size_t most_candidates = 10;

bool may_be_clip_id(const std::string& id) {
  return id.size() >= least_id_digits && id.size() <= id_digits &&
         id.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
}

/// By its name; where the index of names is damaged, by its number, which is as good until another
/// process changes the archive.
std::optional<TakeRecord> find_again(const OpenArchive& archive, const TakeInfo& take) {
  try {
    return archive.store.find_take(take.name);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::damaged) throw;
    return archive.store.take(take.id);
  }
}

/// A take that was found before; another process may have taken it out since.
TakeRecord record_of(const OpenArchive& archive, const TakeInfo& take) {
  std::optional<TakeRecord> record = find_again(archive, take);
  if (!record || record->info.name != take.name ||
      record->info.source_digest != take.source_digest || record->info.frames != take.frames) {
    throw Error(ErrorCode::not_found,
                "the take '" + take.name + "' is not in the archive any more");
  }
  return std::move(*record);
}

std::string candidate_list(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most_candidates); ++i) {
    list += (i > 0 ? ", " : "") + names[i];
  }
  return names.size() > most_candidates ? list + ", ..." : list;
}

[[noreturn]] void throw_ambiguous(const std::string& id, const std::vector<std::string>& names) {
  throw Error(ErrorCode::not_found, "the ID '" + id + "' is ambiguous: " + candidate_list(names),
              {}, "give more of it");
}

[[noreturn]] void throw_unknown(const std::string& what, const std::string& id) {
  throw Error(ErrorCode::not_found, "there is no " + what + " '" + id + "'", {},
              "reprise list shows the names");
}

/// A name need not be UTF-8, a JSON document must be: there is U+FFFD in place of other bytes.
constexpr const char* replacement_character = "\xEF\xBF\xBD";

std::string shown_in_document(const std::string& name) {
  using nlohmann::json;
  const std::string text = json(name).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(text).get<std::string>();
}

/// Names by what a document shows of them: an ID that came out of one is good for other commands.
std::vector<std::string> names_shown_as(const ArchiveStore& store, const std::string& id) {
  std::vector<std::string> names;
  if (id.find(replacement_character) == std::string::npos) return names;
  for (const TakeInfo& take : store.takes({})) {
    const std::string shown = shown_in_document(take.name);
    if (shown == id || shown.ends_with("/" + id)) names.push_back(take.name);
  }
  return names;
}

/// Names that are this one or end in it after a slash. Of x.bvh beside x.amc, whose extensions are
/// parts of their names, x is both.
std::vector<std::string> names_meant(const ArchiveStore& store, const std::string& id) {
  std::vector<std::string> names = store.take_names_ending_in(id, most_candidates + 1);
  if (!names.empty()) return names;
  for (const char* extension : {".amc", ".bvh"}) {
    std::ranges::move(store.take_names_ending_in(id + extension, most_candidates + 1),
                      std::back_inserter(names));
  }
  return names.empty() ? names_shown_as(store, id) : names;
}

/// Names that end in this, wherever it begins: what a short ID may still mean.
std::vector<std::string> names_ending_in(const ArchiveStore& store, const std::string& id) {
  std::vector<std::string> names, without_extension;
  if (id.empty()) return names;
  for (const TakeInfo& take : store.takes({})) {
    if (take.name.ends_with(id)) names.push_back(take.name);
    for (const char* extension : {".amc", ".bvh"}) {
      if (take.name.ends_with(id + extension)) without_extension.push_back(take.name);
    }
  }
  return names.empty() ? without_extension : names;
}

std::optional<TakeInfo> only_take(const ArchiveStore& store, const std::string& id,
                                  const std::vector<std::string>& names) {
  if (names.size() > 1) throw_ambiguous(id, names);
  if (names.empty()) return std::nullopt;
  const auto found = store.find_take(names[0]);
  if (!found) throw Error(ErrorCode::damaged, "the archive is damaged: its index of names");
  return found->info;
}

/// A take by its name, or by its last components.
std::optional<TakeInfo> take_of_name(const ArchiveStore& store, const std::string& id) {
  if (const auto exact = store.find_take(id)) return exact->info;
  return only_take(store, id, names_meant(store, id));
}

/// Greatest of what keeps least.
double coarseness(const Fidelity& fidelity) {
  const bool mean_only = fidelity.tier == FidelityTier::preview;
  return fidelity.limit_mm + (mean_only ? FidelityLimits::greatest_bound_mm : 0);
}

}  // namespace

Archive::Archive(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
Archive::~Archive() = default;
Archive::Archive(Archive&&) noexcept = default;
Archive& Archive::operator=(Archive&&) noexcept = default;

std::vector<TakeInfo> Archive::takes(const TakeFilter& filter) const {
  const auto snapshot = impl_->snapshot();
  return impl_->store.takes(filter);
}

std::vector<TakeInfo> Archive::readable_takes(std::vector<Damage>& damaged) const {
  const auto snapshot = impl_->snapshot();
  return impl_->store.readable_takes(damaged);
}

std::vector<ClipInfo> Archive::clips(const TakeFilter& filter) const {
  const auto snapshot = impl_->snapshot();
  std::vector<ClipInfo> result;
  for (const TakeInfo& take : takes(filter)) {
    const std::int64_t ids[] = {take.id};
    for (const ClipRecord& clip : impl_->store.clips(ids)) {
      if (!filter.kind || clip.kind == *filter.kind) result.push_back(clip_info(clip, take));
    }
  }
  return result;
}

std::vector<SkeletonInfo> Archive::skeletons() const {
  const auto snapshot = impl_->snapshot();
  return impl_->store.skeletons();
}

std::vector<std::string> Archive::subjects() const {
  const auto snapshot = impl_->snapshot();
  return impl_->store.subjects();
}

ArchiveStats Archive::stats() const {
  const auto snapshot = impl_->snapshot();
  DistanceSketches sketches, turns;
  ArchiveStats stats = impl_->store.stats([&](const TakeRecord& record, std::uint64_t distances) {
    sketches.add(record.error_quantiles, distances);
    turns.add(record.turn_quantiles, distances);
  });
  stats.error_mm.p99 = sketches.quantile(0.99);
  stats.rotation_deg.p99 = turns.quantile(0.99);
  return stats;
}

ArchiveInfo Archive::info() const {
  const auto snapshot = impl_->snapshot();
  ArchiveInfo info;
  info.content_digest = hexadecimal(impl_->store.content_digest());
  info.format_version = impl_->store.format_version();
  info.written_by = impl_->store.written_by();
  info.stats = stats();
  return info;
}

TakeInfo Archive::find_take(const std::string& id) const {
  const auto snapshot = impl_->snapshot();
  std::optional<TakeInfo> take = take_of_name(impl_->store, id);
  if (!take) take = only_take(impl_->store, id, names_ending_in(impl_->store, id));
  if (!take) throw_unknown("take", id);
  return *take;
}

std::vector<ClipInfo> Archive::find_clips(const std::string& id) const {
  std::vector<ClipInfo> clips;
  if (!may_be_clip_id(id)) return clips;
  std::string lower = id;
  const auto snapshot = impl_->snapshot();
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'F' ? c + 32 : c);
  for (const ClipRecord& record : impl_->store.clips_with_prefix(lower)) {
    clips.push_back(clip_info(record, impl_->store.take(record.take).info));
  }
  const bool one =
      std::ranges::all_of(clips, [&](const ClipInfo& c) { return c.id == clips[0].id; });
  if (one) return clips;
  std::vector<std::string> ids;
  for (const ClipInfo& clip : clips) {
    if (ids.empty() || ids.back() != clip.id) ids.push_back(clip.id);
  }
  throw_ambiguous(id, ids);
}

Archive::Selection Archive::find(const std::string& id) const {
  const auto snapshot = impl_->snapshot();
  std::optional<TakeInfo> take = take_of_name(impl_->store, id);
  std::optional<ClipInfo> clip;
  if (!take) {
    for (const ClipInfo& candidate : find_clips(id)) {
      TakeInfo of_candidate = find_take(candidate.take);
      if (take && coarseness(of_candidate.fidelity) >= coarseness(take->fidelity)) continue;
      take = std::move(of_candidate);
      clip = candidate;
    }
  }
  // A whole clip ID is found by the index alone, however many takes there are.
  if (!take || (clip && id.size() < id_digits)) {
    std::vector<std::string> names = names_ending_in(impl_->store, id);
    if (clip && !names.empty()) {
      names.insert(names.begin(), clip->id);
      throw_ambiguous(id, names);
    }
    if (!clip) take = only_take(impl_->store, id, names);
  }
  if (clip) return {*take, {clip->first_frame, clip->first_frame + clip->frames}, clip};
  if (!take) throw_unknown(may_be_clip_id(id) ? "take or clip" : "take", id);
  return {*take, {0, take->frames}, std::nullopt};
}

Take Archive::extract(const TakeInfo& info, std::optional<FidelityTier> tier) const {
  const auto snapshot = impl_->snapshot();
  const TakeRecord record = record_of(*impl_, info);
  return decode_layer(*impl_, record, layer_for(record, tier));
}

std::string Archive::source_text(const TakeInfo& info) const {
  const auto snapshot = impl_->snapshot();
  return decode_source_text(*impl_, record_of(*impl_, info));
}

std::shared_ptr<const Skeleton> Archive::skeleton(const TakeInfo& info) const {
  const auto snapshot = impl_->snapshot();
  const TakeRecord record = record_of(*impl_, info);
  return empty_take(impl_->proportions(record.proportions), info.format).skeleton;
}

Take Archive::extract(const TakeInfo& info, FrameRange frames,
                      std::optional<FidelityTier> tier) const {
  if (frames.begin < 0 || frames.begin >= frames.end || frames.end > info.frames) {
    throw Error(ErrorCode::usage,
                "frames " + std::to_string(frames.begin) + " to " + std::to_string(frames.end) +
                    " are not in the take, which has " + std::to_string(info.frames));
  }
  Take take = extract(info, tier);
  const ChannelMatrix part = take.channels.middleRows(frames.begin, frames.end - frames.begin);
  take.channels = part;
  take.layout.first_frame_number += frames.begin;
  return take;
}

}  // namespace reprise

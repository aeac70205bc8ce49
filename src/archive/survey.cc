#include "archive/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "archive/coded_take.h"
#include "archive/parallel.h"

namespace reprise {
namespace {

/// What the first look at a file says.
struct Surveyed {
  std::optional<RejectedInput> rejected;
  TakeOutline outline;
};

Surveyed look_at(const InputFile& file, const IngestOptions& options,
                 const MetadataTable& metadata) {
  Surveyed surveyed;
  try {
    surveyed.outline = outline_take(file, read_options(options.read, metadata.find(file.name)));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::rejected_input && error.code() != ErrorCode::limit) throw;
    surveyed.rejected = rejection(file, error);
  }
  return surveyed;
}

/// Whether a stored take has what its row says of it; an empty subject says nothing.
bool told_by(const TakeMetadata* row, const TakeInfo& stored) {
  return row == nullptr || ((row->subject.empty() || row->subject == stored.subject) &&
                            row->description == stored.description && row->tags == stored.tags);
}

/// Decides what becomes of each file in turn.
class Deciding {
 public:
  Deciding(const std::vector<InputFile>& files, const IngestOptions& options,
           const MetadataTable& metadata, const ArchiveStore* store, Survey& survey)
      : options_(options), metadata_(metadata), store_(store), survey_(survey) {
    for (const InputFile& file : files) names_.insert(file.name);
  }

  void decide(const InputFile& file, TakeOutline outline) {
    const TakeMetadata* row = metadata_.find(file.name);
    const std::optional<TakeRecord> stored = stored_take(file, outline);
    FreshTake fresh{file, std::move(outline), row != nullptr ? *row : TakeMetadata{}, false};
    if (!stored) {
      survey_.fresh.push_back(std::move(fresh));
      return;
    }
    fresh.file.name = stored->info.name;
    names_.insert(stored->info.name);
    decide_again(std::move(fresh), *stored, row);
  }

 private:
  /// Where the take is stored already.
  void decide_again(FreshTake fresh, const TakeRecord& stored, const TakeMetadata* row) {
    const std::string& name = stored.info.name;
    const bool same_source = stored.info.source_digest == fresh.outline.source_digest;
    const bool same_fidelity = stored.info.fidelity == options_.fidelity;
    const bool same_metadata = told_by(row, stored.info);
    const bool same_reading = read_as_asked(fresh.outline, stored, row);
    const bool same = same_fidelity && same_metadata && same_reading;
    if (same_source && (same || !options_.replace)) {
      survey_.skipped.push_back(name);
      if (!same_fidelity) survey_.other_fidelity.push_back(name);
      if (!same_metadata) survey_.other_metadata.push_back(name);
      if (!same_reading) survey_.other_reading.push_back(name);
    } else if (options_.replace) {
      // Without a row nothing is said of the take, and what was said before stays.
      if (row == nullptr) {
        fresh.metadata.subject = stored.info.subject;
        fresh.metadata.description = stored.info.description;
        fresh.metadata.tags = stored.info.tags;
      }
      fresh.replaces = true;
      survey_.fresh.push_back(std::move(fresh));
    } else {
      survey_.rejected.push_back({fresh.file.path.string(), 0,
                                  "a take '" + name + "' with other content is stored already",
                                  "--replace replaces it, --prefix P gives the new one another "
                                  "name"});
    }
  }

  /// Whether a stored take has the unit, up axis or frame rate that is asked for, where one is.
  bool read_as_asked(const TakeOutline& outline, const TakeRecord& stored,
                     const TakeMetadata* row) const {
    const ReadOptions read = read_options(options_.read, row);
    if (read.up && *read.up != stored.info.up) return false;
    if (read.frame_rate && outline.frame_rate != stored.info.frame_rate) return false;
    return stored.info.format == MotionFormat::asf_amc || !read.bvh_millimetres_per_unit ||
           outline.skeleton->millimetres_per_unit == stored.info.unit_mm;
  }

  /// The stored take that a file is about: of its name, or the same file under the name that it had
  /// when another one stood beside it, or when none did (x.bvh beside x.amc).
  std::optional<TakeRecord> stored_take(const InputFile& file, const TakeOutline& outline) const {
    if (store_ == nullptr) return std::nullopt;
    if (std::optional<TakeRecord> same_name = store_->find_take(file.name)) return same_name;
    const std::string extension = file.path.extension().string();
    const std::string other = file.name.ends_with(extension)
                                  ? file.name.substr(0, file.name.size() - extension.size())
                                  : file.name + extension;
    if (names_.contains(other)) return std::nullopt;
    std::optional<TakeRecord> renamed = store_->find_take(other);
    const bool same_source = renamed && renamed->info.source_digest == outline.source_digest;
    return same_source ? renamed : std::nullopt;
  }

  const IngestOptions& options_;
  const MetadataTable& metadata_;
  const ArchiveStore* store_;
  Survey& survey_;
  std::set<std::string> names_;  ///< of all files, and those that were found under another one
};

/// Notes of takes that are to be stored, and which of them are stored under another name, or will
/// be.
void describe_fresh(const ArchiveStore* store, Survey& survey) {
  if (survey.fresh.empty()) return;
  std::set<std::string> replaced;
  for (const FreshTake& fresh : survey.fresh) {
    if (fresh.replaces) replaced.insert(fresh.file.name);
    for (const SourceNote& note : fresh.outline.notes) {
      survey.notes.push_back({fresh.file.path.string(), note.line, note.what});
    }
  }
  std::map<std::string, std::string> names;  // of source digests: the first in order
  if (store != nullptr) {
    store->for_each_take([&](const TakeRecord& record) {
      if (replaced.contains(record.info.name)) return;
      const auto [entry, added] = names.emplace(record.info.source_digest, record.info.name);
      if (!added) entry->second = std::min(entry->second, record.info.name);
    });
  }
  for (const FreshTake& fresh : survey.fresh) {
    const auto [entry, added] = names.emplace(fresh.outline.source_digest, fresh.file.name);
    if (!added) survey.same_source.push_back({fresh.file.name, entry->second});
  }
}

/// Moves takes that cannot be coded on this machine from `fresh` to `rejected`.
void reject_too_large(std::size_t memory_bytes, Survey& survey) {
  std::vector<FreshTake> fitting;
  for (FreshTake& fresh : survey.fresh) {
    const TakeOutline& outline = fresh.outline;
    const std::size_t needed = coding_memory(*outline.skeleton, outline.frames);
    if (needed <= memory_bytes) {
      fitting.push_back(std::move(fresh));
      continue;
    }
    constexpr double megabyte = 1e6;
    survey.rejected.push_back(
        {fresh.file.path.string(), 0,
         fmt::format("coding its {} frames takes about {:.0f} MB of memory, and {:.0f} MB are free",
                     outline.frames, static_cast<double>(needed) / megabyte,
                     static_cast<double>(memory_bytes) / megabyte),
         "cut it into shorter takes, or use a machine with more memory"});
  }
  survey.fresh = std::move(fitting);
}

}  // namespace

RejectedInput rejection(const InputFile& file, const Error& error) {
  const SourcePlace& place = error.place();
  if (place.file.empty() || place.file == file.path.string()) {
    return {file.path.string(), place.line, error.reason(), error.advice()};
  }
  // An ASF is to blame; what was not taken in is each AMC of it.
  return {place.file, place.line,
          fmt::format("{}; {} needs it", error.reason(), file.path.string()), error.advice()};
}

Survey survey_files(const std::vector<InputFile>& files, const IngestOptions& options,
                    const MetadataTable& metadata, const ArchiveStore* store,
                    std::size_t memory_bytes, const std::function<void(const std::string&)>& tick) {
  Survey survey;
  Deciding deciding(files, options, metadata, store, survey);
  produce_in_order(
      files.size(), options.jobs,
      [&](std::size_t i) { return look_at(files[i], options, metadata); },
      [&](std::size_t i, Surveyed surveyed) {
        tick(files[i].name);
        if (surveyed.rejected) {
          survey.rejected.push_back(std::move(*surveyed.rejected));
        } else {
          deciding.decide(files[i], std::move(surveyed.outline));
        }
      });
  reject_too_large(memory_bytes, survey);
  describe_fresh(store, survey);
  survey.readings = settle_readings(survey.fresh, options.read, store);
  return survey;
}

}  // namespace reprise

#include "archive/survey.h"

#include <fmt/format.h>

#include <optional>

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
    surveyed.outline = outline_take(file, options.read);
    const TakeMetadata* row = metadata.find(file.name);
    if (row != nullptr && !row->subject.empty()) surveyed.outline.subject = row->subject;
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

/// Where a take of that name is stored already: what becomes of the file.
void decide(const InputFile& file, TakeOutline outline, const TakeRecord& stored,
            const IngestOptions& options, const MetadataTable& metadata, Survey& survey) {
  const bool same_source = stored.info.source_digest == outline.source_digest;
  const bool same_fidelity = stored.info.fidelity.tier == options.fidelity.tier &&
                             stored.info.fidelity.limit_mm == options.fidelity.limit_mm;
  const bool same_metadata = told_by(metadata.find(file.name), stored.info);
  if (same_source && ((same_fidelity && same_metadata) || !options.replace)) {
    survey.skipped.push_back(file.name);
    if (!same_fidelity) survey.other_fidelity.push_back(file.name);
    if (!same_metadata) survey.other_metadata.push_back(file.name);
  } else if (options.replace) {
    survey.fresh.push_back({file, std::move(outline), true});
  } else {
    survey.rejected.push_back({file.path.string(), 0,
                               "a take '" + file.name +
                                   "' with other content is stored already; --replace "
                                   "replaces it, --prefix P gives the new "
                                   "one another name"});
  }
}

/// The stored take that a file is about: of its name, or the same file under the name that it had
/// when another one stood beside it, or when none did (x.bvh beside x.amc).
std::optional<TakeRecord> stored_take(const InputFile& file, const TakeOutline& outline,
                                      const ArchiveStore& store) {
  if (std::optional<TakeRecord> same_name = store.find_take(file.name)) return same_name;
  const std::string extension = file.path.extension().string();
  const std::string other = file.name.ends_with(extension)
                                ? file.name.substr(0, file.name.size() - extension.size())
                                : file.name + extension;
  std::optional<TakeRecord> renamed = store.find_take(other);
  const bool same_source = renamed && renamed->info.source_digest == outline.source_digest;
  return same_source ? renamed : std::nullopt;
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
         fmt::format(
             "coding its {} frames takes about {:.0f} MB of memory, and {:.0f} MB are free; "
             "cut it into shorter takes, or use a machine with more memory",
             outline.frames, static_cast<double>(needed) / megabyte,
             static_cast<double>(memory_bytes) / megabyte)});
  }
  survey.fresh = std::move(fitting);
}

}  // namespace

RejectedInput rejection(const InputFile& file, const Error& error) {
  std::string why = error.reason();
  if (!error.advice().empty()) why += "; " + error.advice();
  const SourcePlace& place = error.place();
  if (place.file.empty() || place.file == file.path.string()) {
    return {file.path.string(), place.line, why};
  }
  // An ASF is to blame; what was not taken in is each AMC of it.
  return {place.file, place.line, fmt::format("{}; {} needs it", why, file.path.string())};
}

Survey survey_files(const std::vector<InputFile>& files, const IngestOptions& options,
                    const MetadataTable& metadata, const ArchiveStore* store,
                    std::size_t memory_bytes, const std::function<void(const std::string&)>& tick) {
  Survey survey;
  produce_in_order(
      files.size(), options.jobs,
      [&](std::size_t i) { return look_at(files[i], options, metadata); },
      [&](std::size_t i, Surveyed surveyed) {
        tick(files[i].name);
        if (surveyed.rejected) {
          survey.rejected.push_back(std::move(*surveyed.rejected));
          return;
        }
        const auto stored =
            store != nullptr ? stored_take(files[i], surveyed.outline, *store) : std::nullopt;
        if (stored) {
          InputFile file = files[i];
          file.name = stored->info.name;
          decide(file, std::move(surveyed.outline), *stored, options, metadata, survey);
        } else {
          survey.fresh.push_back({files[i], std::move(surveyed.outline), false});
        }
      });
  reject_too_large(memory_bytes, survey);
  return survey;
}

}  // namespace reprise

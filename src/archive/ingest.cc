// Drives an ingest: finds the takes, makes the spaces that they need, codes and stores them.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "archive/clip_links.h"
#include "archive/coded_take.h"
#include "archive/estimate.h"
#include "archive/input_files.h"
#include "archive/metadata.h"
#include "archive/parallel.h"
#include "archive/space_builder.h"
#include "archive/survey.h"
#include "model/free_memory.h"
#include "model/memory_budget.h"
#include "reprise/archive.h"
#include "reprise/error.h"
#include "store/archive_store.h"

namespace reprise {
namespace {

/// Takes are stored together until this much coded motion or this many of them has come together; a
/// stopped ingest loses no more than that.
constexpr std::size_t batch_bytes = 1u << 20;
constexpr std::size_t batch_takes = 64;

class Ingest {
 public:
  Ingest(const std::filesystem::path& archive, const IngestOptions& options,
         const ProgressSink& progress)
      : archive_(archive),
        options_(options),
        progress_(progress),
        memory_bytes_(options.memory_bytes > 0 ? options.memory_bytes : free_memory()) {}

  IngestReport run() {
    for (const std::filesystem::path& asf : options_.read.asf) read_whole_file(asf);
    if (options_.metadata) metadata_ = MetadataTable::read(*options_.metadata);
    InputFiles inputs = find_input_files(options_.paths, options_.prefix, [&] { tick({}); });
    report_.rejected = std::move(inputs.rejected);
    report_.other_kinds = std::move(inputs.other_kinds);
    files_ = std::move(inputs.files);
    std::vector<std::string> names;
    for (const InputFile& file : files_) names.push_back(file.name);
    report_.takes_not_found = metadata_.rows_of_none(names);
    total_ = (options_.repeats ? 4 : 3) * files_.size();
    if (options_.dry_run) {
      if (std::filesystem::exists(archive_)) store_ = ArchiveStore::open_for_reading(archive_);
    } else {
      store_ = ArchiveStore::open_for_writing(archive_, [&] {
        return !progress_ || progress_({std::min(done_, total_), total_, {}, true});
      });
    }
    survey();
    if (options_.dry_run) {
      report_.estimate = estimate_ingest(fresh_, options_, [&] { tick({}); });
      for (const FreshTake& fresh : fresh_) report_.added.push_back(fresh.file.name);
    } else {
      store_structures();
      if (options_.repeats) {
        plan_ = plan_clips(archive_, fresh_, spaces_, options_,
                           [&](const std::string& current) { tick(current); });
      }
      code_and_store();
      link_clips(*store_, plan_, {report_.added.begin(), report_.added.end()});
    }
    list_replaced();
    std::sort(report_.rejected.begin(), report_.rejected.end(),
              [](const RejectedInput& a, const RejectedInput& b) { return a.path < b.path; });
    return std::move(report_);
  }

 private:
  /// A take is done; without a name it is only asked whether to go on.
  void tick(const std::string& current) {
    if (!current.empty()) ++done_;
    if (progress_ && !progress_({std::min(done_, total_), total_, current})) {
      const bool some = !report_.added.empty() || !pending_.empty();
      throw Error(ErrorCode::interrupted,
                  some ? "stopped; what is stored stays, and running it again goes on"
                       : "stopped before a take was stored");
    }
  }

  void survey() {
    Survey survey = survey_files(files_, options_, metadata_, store_ ? &*store_ : nullptr,
                                 memory_bytes_, [&](const std::string& current) { tick(current); });
    std::ranges::move(survey.rejected, std::back_inserter(report_.rejected));
    report_.skipped = std::move(survey.skipped);
    report_.other_fidelity = std::move(survey.other_fidelity);
    report_.other_metadata = std::move(survey.other_metadata);
    report_.other_reading = std::move(survey.other_reading);
    report_.assumed_units = std::move(survey.readings.assumed_units);
    report_.implausible_units = std::move(survey.readings.implausible_units);
    report_.same_source = std::move(survey.same_source);
    report_.notes = std::move(survey.notes);
    fresh_ = std::move(survey.fresh);
  }

  /// Of what was added; what is told of takes that were not is dropped.
  void list_replaced() {
    const std::set<std::string> added(report_.added.begin(), report_.added.end());
    for (const FreshTake& fresh : fresh_) {
      if (fresh.replaces && added.contains(fresh.file.name)) {
        report_.replaced.push_back(fresh.file.name);
      }
    }
    std::erase_if(report_.same_source,
                  [&](const SameSource& same) { return !added.contains(same.name); });
  }

  /// Skeletons, proportions and spaces come first, so that a stopped ingest goes on with the same
  /// axes.
  void store_structures() {
    SpaceBuilder builder(*store_, options_);
    spaces_ = builder.build(fresh_, [&](const std::string& current) { tick(current); });
    // What takes replace goes with them, but for what those need that come after.
    for (const auto& [name, assignment] : spaces_) store_->hold_proportions(assignment.proportions);
  }

  void code_and_store() {
    code_and_store(fresh_, spaces_);
    if (unkept_.empty()) return;
    // Odd skeletons may move in ways that markers do not carry: their channels are coded as they
    // are.
    const std::vector<FreshTake> odd = std::move(unkept_);
    unkept_.clear();
    spaces_ = SpaceBuilder(*store_, options_).build_plain(odd, spaces_);
    code_and_store(odd, spaces_);
    for (const FreshTake& fresh : unkept_) {
      report_.rejected.push_back({fresh.file.path.string(), 0,
                                  "the motion cannot be coded within the promised error",
                                  "--fidelity exact stores any motion"});
    }
  }

  void code_and_store(const std::vector<FreshTake>& takes,
                      const std::map<std::string, SpaceAssignment>& spaces) {
    std::size_t bytes = 0, stored = 0;
    MemoryBudget memory(memory_bytes_);
    const auto commit = [&] {
      bytes = 0;
      if (std::exchange(stored, 0) > 0) store_->commit();
      for (std::string& name : pending_) report_.added.push_back(std::move(name));
      pending_.clear();
    };
    try {
      produce_in_order(
          takes.size(), options_.jobs,
          [&](std::size_t i) {
            const TakeOutline& outline = takes[i].outline;
            const auto share = memory.take(coding_memory(*outline.skeleton, outline.frames));
            return code_take(takes[i], spaces.at(takes[i].file.name), plan_, options_);
          },
          [&](std::size_t i, CodedTake coded) {
            if (coded.rejected) {
              report_.rejected.push_back(*coded.rejected);
            } else if (!coded.kept) {
              unkept_.push_back(takes[i]);
            } else {
              if (stored == 0) store_->begin();
              store_take(takes[i], coded);
              bytes += coded.bytes();
              if (++stored >= batch_takes || bytes >= batch_bytes) commit();
            }
            tick(takes[i].file.name);
          });
    } catch (const Error& error) {
      // The batch at hand is coded already.
      if (error.code() == ErrorCode::interrupted) commit();
      throw;
    }
    commit();
  }

  void store_take(const FreshTake& fresh, const CodedTake& coded) {
    if (fresh.replaces) {
      if (const auto old = store_->find_take(fresh.file.name)) store_->remove_take(old->info.id);
    }
    store_->add_take(coded.record, coded.clips);
    pending_.push_back(fresh.file.name);
  }

  std::filesystem::path archive_;
  const IngestOptions& options_;
  const ProgressSink& progress_;
  std::size_t memory_bytes_;
  MetadataTable metadata_;
  std::vector<InputFile> files_;
  std::vector<FreshTake> fresh_;
  std::vector<FreshTake> unkept_;
  std::map<std::string, SpaceAssignment> spaces_;
  ClipPlan plan_;
  std::optional<ArchiveStore> store_;
  std::vector<std::string> pending_;
  IngestReport report_;
  std::size_t done_ = 0, total_ = 0;
};

}  // namespace

IngestReport ingest(const std::filesystem::path& archive, const IngestOptions& options,
                    const ProgressSink& progress) {
  const auto start = std::chrono::steady_clock::now();
  IngestReport report = Ingest(archive, options, progress).run();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace reprise

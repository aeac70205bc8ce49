#include "archive/estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <system_error>

#include "reprise/error.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// A sample of this many takes, or fewer of so many numbers: some seconds of work.
constexpr std::size_t most_takes = 8;
constexpr std::uint64_t most_numbers = 2'000'000;

/// An empty folder for as long as it lives.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    const fs::path place = fs::temp_directory_path(error);
    std::string pattern = (place / "reprise-sample-XXXXXX").string();
    if (error || ::mkdtemp(pattern.data()) == nullptr) {
      throw Error(ErrorCode::failed, "no folder can be made for a sample of the takes",
                  {place.string()});
    }
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::uint64_t numbers_of(const FreshTake& take) {
  return static_cast<std::uint64_t>(take.outline.frames) *
         static_cast<std::uint64_t>(take.outline.skeleton->channel_count);
}

/// Indices of takes, spread evenly; at least one. Their files have different names.
std::vector<std::size_t> sample_of(const std::vector<FreshTake>& takes) {
  std::vector<std::size_t> sample;
  std::set<std::string> stems;
  std::uint64_t numbers = 0;
  const std::size_t wanted = std::min(most_takes, takes.size());
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::size_t index = (2 * i + 1) * takes.size() / (2 * wanted);
    const FreshTake& take = takes[index];
    if (!sample.empty() && numbers + numbers_of(take) > most_numbers) continue;
    if (!stems.insert(take.file.path.stem().string()).second) continue;
    numbers += numbers_of(take);
    sample.push_back(index);
  }
  return sample;
}

std::optional<IngestEstimate> estimate_from_sample(const std::vector<FreshTake>& takes,
                                                   const IngestOptions& options,
                                                   const std::function<void()>& pulse) {
  const TemporaryFolder folder;
  const fs::path archive = folder.path() / "sample.rpz";
  IngestOptions sampling;
  sampling.fidelity = options.fidelity;
  sampling.read = options.read;
  sampling.jobs = options.jobs;
  sampling.contacts = options.contacts;
  sampling.repeats = options.repeats;
  sampling.memory_bytes = options.memory_bytes;
  for (const std::size_t i : sample_of(takes)) sampling.paths.push_back(takes[i].file.path);
  const IngestReport report = ingest(archive, sampling, [&](const Progress&) {
    pulse();
    return true;
  });
  if (report.added.empty()) return std::nullopt;
  const ArchiveStats stats = Archive(archive).stats();
  double numbers = 0;
  for (const FreshTake& take : takes) numbers += static_cast<double>(numbers_of(take));
  const double more = numbers * sizeof(float) / static_cast<double>(stats.raw_bytes);
  IngestEstimate estimate;
  estimate.sampled = report.added.size();
  // Skeletons and axes are there once; what they take of a larger library is nearly nothing.
  estimate.bytes = stats.archive_bytes +
                   static_cast<std::uint64_t>(std::llround(
                       std::max(0.0, more - 1) * static_cast<double>(stats.payload_bytes)));
  estimate.seconds = report.seconds * std::max(1.0, more);
  return estimate;
}

}  // namespace

std::optional<IngestEstimate> estimate_ingest(const std::vector<FreshTake>& takes,
                                              const IngestOptions& options,
                                              const std::function<void()>& pulse) {
  if (takes.empty()) return std::nullopt;
  try {
    return estimate_from_sample(takes, options, pulse);
  } catch (const Error& error) {
    // A folder for temporary files that is full or closed says nothing of the ingest.
    if (error.code() != ErrorCode::failed && error.code() != ErrorCode::limit) throw;
    return std::nullopt;
  }
}

}  // namespace reprise

// How fast takes go in and come out, as multiples of real time on one core.
// REPRISE_BENCH_TAKES names a folder of takes; without it, synthetic ones are made.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "reprise/archive.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// A folder that goes when the program ends, with one archive for each fidelity that was asked for.
class Library {
 public:
  Library() {
    std::string pattern = (fs::temp_directory_path() / "reprise-bench-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    if (const char* takes = std::getenv("REPRISE_BENCH_TAKES")) {
      takes_ = takes;
      return;
    }
    takes_ = folder_ / "takes";
    SynthOptions options;
    options.takes = 40;
    options.seconds = 15;
    write_synthetic_library(takes_, options, true);
  }
  ~Library() { fs::remove_all(folder_); }

  const fs::path& takes() const { return takes_; }
  fs::path new_archive() const { return folder_ / "new.rpz"; }

  const Archive& archive(FidelityTier tier) {
    const auto known = archives_.find(tier);
    if (known != archives_.end()) return known->second;
    const fs::path path = folder_ / tier_name(tier);
    store(path, tier, 2);
    return archives_.emplace(tier, Archive(path)).first->second;
  }

  void store(const fs::path& path, FidelityTier tier, unsigned jobs) const {
    IngestOptions options;
    options.paths = {takes_};
    options.fidelity = fidelity_of(tier);
    options.jobs = jobs;
    ingest(path, options);
  }

 private:
  fs::path folder_, takes_;
  std::map<FidelityTier, Archive> archives_;
};

Library& library() {
  static Library made;
  return made;
}

FidelityTier tier_of(const benchmark::State& state) {
  return static_cast<FidelityTier>(state.range(0));
}

void report(benchmark::State& state, double seconds, double text_bytes) {
  const auto rounds = static_cast<double>(state.iterations());
  using benchmark::Counter;
  state.counters["times_real"] = Counter(seconds * rounds, Counter::kIsRate);
  state.counters["text_bytes"] = Counter(text_bytes * rounds, Counter::kIsRate);
  state.SetLabel(tier_name(tier_of(state)));
}

void report(benchmark::State& state, const std::vector<TakeInfo>& takes) {
  double seconds = 0, bytes = 0;
  for (const TakeInfo& take : takes) {
    seconds += take.seconds();
    bytes += static_cast<double>(take.text_bytes);
  }
  report(state, seconds, bytes);
}

void decode_every_take(benchmark::State& state) {
  const Archive& archive = library().archive(tier_of(state));
  const std::vector<TakeInfo> takes = archive.takes();
  for (auto _ : state) {
    for (const TakeInfo& take : takes) benchmark::DoNotOptimize(archive.extract(take));
  }
  report(state, takes);
}

void source_texts(benchmark::State& state) {
  const Archive& archive = library().archive(FidelityTier::exact);
  const std::vector<TakeInfo> takes = archive.takes();
  for (auto _ : state) {
    for (const TakeInfo& take : takes) benchmark::DoNotOptimize(archive.source_text(take));
  }
  report(state, takes);
}

void extract_one_take_by_its_name(benchmark::State& state) {
  const std::vector<TakeInfo> takes = library().archive(tier_of(state)).takes();
  const TakeInfo& shortest = *std::ranges::min_element(takes, {}, &TakeInfo::frames);
  const Archive& archive = library().archive(tier_of(state));
  for (auto _ : state) {
    benchmark::DoNotOptimize(archive.extract(archive.find_take(shortest.name)));
  }
  report(state, shortest.seconds(), static_cast<double>(shortest.text_bytes));
}

void ingest_on_two_jobs(benchmark::State& state) {
  double seconds = 0, bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    fs::remove(library().new_archive());
    state.ResumeTiming();
    library().store(library().new_archive(), tier_of(state), 2);
    const ArchiveStats stats = Archive(library().new_archive()).stats();
    seconds = stats.seconds;
    bytes = static_cast<double>(stats.text_bytes);
  }
  report(state, seconds, bytes);
}

void every_tier(benchmark::internal::Benchmark* made) {
  for (const FidelityTier tier :
       {FidelityTier::preview, FidelityTier::standard, FidelityTier::fine, FidelityTier::exact}) {
    made->Arg(static_cast<int>(tier));
  }
  made->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(decode_every_take)->Apply(every_tier);
BENCHMARK(source_texts)
    ->Arg(static_cast<int>(FidelityTier::exact))
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(extract_one_take_by_its_name)->Apply(every_tier);
BENCHMARK(ingest_on_two_jobs)->Apply(every_tier);

}  // namespace
}  // namespace reprise

BENCHMARK_MAIN();

#include "fuzz/sample_archive.h"

#include "fuzz/scratch_folder.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

fs::path make_sample_archive() {
  const fs::path& folder = scratch_folder();
  const fs::path archive = folder / "sample.rpz";
  std::uint64_t seed = 1;
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    for (const FidelityTier tier :
         {FidelityTier::preview, FidelityTier::standard, FidelityTier::exact}) {
      SynthOptions options;
      options.takes = 1;
      options.seconds = 0.4;
      options.subjects = 1;
      options.seed = seed++;
      options.format = format;
      const fs::path source = folder / ("source" + std::to_string(seed));
      write_synthetic_library(source, options, true);
      IngestOptions ingest_options;
      ingest_options.paths = {source};
      ingest_options.prefix = std::to_string(seed);
      ingest_options.fidelity = fidelity_of(tier);
      ingest(archive, ingest_options);
      fs::remove_all(source);
    }
  }
  return archive;
}

}  // namespace

const fs::path& sample_archive() {
  static const fs::path path = make_sample_archive();
  return path;
}

std::vector<TakeRecord> sample_records(const ArchiveStore& store) {
  std::vector<TakeRecord> records;
  for (const TakeInfo& info : store.takes({})) {
    TakeRecord record = store.take(info.id);
    for (std::size_t i = 0; i < record.layers.size(); ++i)
      record.layers[i].data = store.layer(info.id, i);
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace reprise

// The small files that users write, and the cache that a search keeps: joint maps, metadata,
// features.
#include <xxhash.h>

#include "archive/metadata.h"
#include "fuzz/fuzz_input.h"
#include "fuzz/sample_archive.h"
#include "fuzz/scratch_folder.h"
#include "query/motion_library.h"
#include "reprise/error.h"
#include "reprise/query/motion_search.h"

using namespace reprise;

namespace {

void read_tables(const std::filesystem::path& path) {
  try {
    read_joint_map(path);
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::rejected_input, error.what());
  }
  try {
    const MetadataTable table = MetadataTable::read(path);
    table.find("walks/take_1");
    table.rows_of_none({});
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::failed, error.what());
  }
}

/// The bytes with the checksum that a cache ends in, beside an archive that is searched.
void search_with_cache(std::string bytes) {
  const std::uint64_t checksum = XXH3_64bits(bytes.data(), bytes.size());
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  write_scratch(search_cache_path(sample_archive()), bytes);
  MotionSearch search(sample_archive(), {.jobs = 1});
  const Archive archive(sample_archive());
  for (const TakeInfo& info : archive.takes()) search.like(info);
}

}  // namespace

/// Input: table or cache, its bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  if (input.choice(2) == 1) {
    search_with_cache(std::string(input.text()));
  } else {
    write_scratch(scratch_folder() / "table", input.text());
    read_tables(scratch_folder() / "table");
  }
  return 0;
}

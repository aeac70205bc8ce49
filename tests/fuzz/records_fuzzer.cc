// Records with right digests that do not fit each other, written as an archive is; then everything
// is read, and more is added.
#include "fuzz/archive_questions.h"
#include "fuzz/forged_take.h"
#include "fuzz/sample_archive.h"
#include "fuzz/scratch_folder.h"
#include "reprise/error.h"

using namespace reprise;

namespace {

Forged take_apart(const ArchiveStore& store, const TakeRecord& take) {
  Forged forged;
  forged.take = take;
  forged.proportions = store.proportions(take.proportions);
  forged.skeleton = store.skeleton(forged.proportions.skeleton);
  if (take.space != 0) forged.space = store.space(take.space);
  const std::int64_t ids[] = {take.info.id};
  forged.clips = store.clips(ids);
  return forged;
}

void write_forged(const std::filesystem::path& path, Forged forged) {
  ArchiveStore store = ArchiveStore::open_for_writing(path);
  store.begin();
  forged.proportions.skeleton = store.add_skeleton(forged.skeleton);
  forged.take.proportions = store.add_proportions(forged.proportions);
  if (forged.take.space != 0) {
    forged.space.skeleton = forged.proportions.skeleton;
    forged.take.space = store.add_space(forged.space);
  }
  forged.take.info.name = "forged";
  store.add_take(forged.take, forged.clips);
  store.commit();
}

}  // namespace

/// Input: the questions that are asked, whether other takes are beside it, which take of the
/// sample, then edits of it and of what it needs.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string good = read_scratch(sample_archive());
  static const ArchiveStore sample = ArchiveStore::open_for_reading(sample_archive());
  static const std::vector<TakeRecord> records = sample_records(sample);
  const std::filesystem::path path = scratch_folder() / "forged.rpz";
  FuzzInput input(data, size);
  const auto questions = static_cast<Questions>(input.choice(question_kinds));
  const bool alone = input.choice(2) == 1;
  Forged forged = take_apart(sample, records[input.choice(records.size())]);
  for (int edits = 0; edits < 8 && !input.empty(); ++edits) edit(forged, input);
  mend(forged);
  std::filesystem::remove(path);
  if (!alone) write_scratch(path, good);
  try {
    write_forged(path, std::move(forged));
  } catch (const Error&) {
    return 0;  // what cannot be stored, such as a rate that is no number
  }
  try {
    ask_archive(path, questions);
    remove_takes(path, {"forged"});
    compact(path);
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::damaged || error.code() == ErrorCode::limit, error.what());
  }
  return 0;
}

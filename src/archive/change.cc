// Takes out takes, and gives back their space.
#include <set>

#include "reprise/archive.h"
#include "reprise/error.h"
#include "store/archive_store.h"

namespace reprise {

namespace {

WaitNotice notice_of(const ProgressSink& progress) {
  return [&progress] { return !progress || progress({0, 1, {}, true}); };
}

}  // namespace

void remove_takes(const std::filesystem::path& archive, const std::vector<std::string>& names,
                  const ProgressSink& progress) {
  { const Archive must_be_readable(archive); }
  ArchiveStore store = ArchiveStore::open_for_writing(archive, notice_of(progress));
  store.begin();
  try {
    for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
      const auto take = store.find_take(name);
      if (!take) throw Error(ErrorCode::not_found, "there is no take '" + name + "'");
      store.remove_take(take->info.id);
    }
  } catch (...) {
    store.roll_back();
    throw;
  }
  store.commit();
}

void compact(const std::filesystem::path& archive, const ProgressSink& progress) {
  { const Archive must_be_readable(archive); }
  ArchiveStore::open_for_writing(archive, notice_of(progress)).compact();
}

}  // namespace reprise

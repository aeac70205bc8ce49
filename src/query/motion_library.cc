#include "query/motion_library.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "model/free_memory.h"
#include "model/memory_budget.h"
#include "model/start_threads.h"
#include "query/take_decoder.h"
#include "reprise/error.h"
#include "store/digest.h"

namespace reprise {
namespace {

/// How often a reading is begun again because a writer took takes out meanwhile.
constexpr int most_attempts = 10;

/// Reads keys of takes: of all that their postures depend on.
class TakeKeys {
 public:
  TakeKeys(const ArchiveStore& store, const JointMap& map) : store_(store), map_(map) {}

  Digest key_of(const TakeRecord& take) {
    Hasher hasher;
    hasher.add_text(take.info.name);
    hasher.add_bytes(known(proportions_, take.proportions,
                           [&] { return store_.proportions(take.proportions).identity; }));
    hasher.add_bytes(
        known(spaces_, take.space, [&] { return store_.digest_of_space(take.space); }));
    for (const LayerRecord& layer : take.layers) hasher.add_bytes(layer.digest);
    for (const auto& [joint, name] : map_) {
      hasher.add_number(static_cast<int>(joint));
      hasher.add_text(name);
    }
    return hasher.finish();
  }

 private:
  using Digests = std::map<std::int64_t, Digest>;
  template <class Read>
  static const Digest& known(Digests& digests, std::int64_t id, const Read& read) {
    const auto found = digests.find(id);
    return found != digests.end() ? found->second : digests.emplace(id, read()).first->second;
  }

  const ArchiveStore& store_;
  const JointMap& map_;
  Digests proportions_, spaces_;
};

/// Every take of one state of an archive, by name, with its key.
std::vector<std::pair<TakeInfo, Digest>> keyed_takes(const std::filesystem::path& archive,
                                                     const JointMap& map) {
  const ArchiveStore store = ArchiveStore::open_for_reading(archive);
  const auto snapshot = store.snapshot();
  TakeKeys keys(store, map);
  std::vector<std::pair<TakeInfo, Digest>> takes;
  store.for_each_take(
      [&](const TakeRecord& take) { takes.emplace_back(take.info, keys.key_of(take)); });
  std::ranges::sort(takes, {}, [](const auto& take) { return take.first.name; });
  return takes;
}

bool by_key(const LibraryTake& a, const LibraryTake& b) { return a.key < b.key; }

/// Decodes takes on several threads, each with the archive opened for itself.
class Decoding {
 public:
  Decoding(const std::filesystem::path& archive, const JointMap& map,
           const std::vector<TakeInfo>& infos, std::vector<LibraryTake>& takes,
           std::vector<std::size_t> missing)
      : archive_(archive), map_(map), infos_(infos), takes_(takes), missing_(std::move(missing)) {}

  void run(unsigned jobs, const ProgressSink& progress) {
    if (jobs == 0) jobs = std::max(1u, std::thread::hardware_concurrency());
    {
      std::vector<std::jthread> threads;
      const std::size_t most = std::min<std::size_t>(jobs, missing_.size());
      try {
        if (most > 1) start_threads(threads, most - 1, [this] { work({}); });
      } catch (...) {
        stopped_ = true;
        throw;
      }
      work(progress);
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void work(const ProgressSink& progress) {
    try {
      const Archive archive(archive_);
      for (std::size_t i; !stopped_ && (i = next_++) < missing_.size();) {
        const TakeInfo& info = infos_[missing_[i]];
        const auto share = memory_.take(decoding_memory(info));
        takes_[missing_[i]].track = posture_track(archive.extract(info), map_);
        if (progress && !progress({i + 1, missing_.size(), info.name})) {
          throw Error(ErrorCode::interrupted, "interrupted");
        }
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stopped_ = true;
    }
  }

  const std::filesystem::path& archive_;
  const JointMap& map_;
  const std::vector<TakeInfo>& infos_;
  std::vector<LibraryTake>& takes_;
  std::vector<std::size_t> missing_;
  MemoryBudget memory_{free_memory()};
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

Digest content_digest(const std::filesystem::path& archive) {
  return ArchiveStore::open_for_reading(archive).content_digest();
}

}  // namespace

std::vector<LibraryTake> read_library(const std::filesystem::path& archive,
                                      const SearchSetup& setup, std::vector<LibraryTake> cached,
                                      const ProgressSink& progress) {
  for (int attempt = 1;; ++attempt) {
    const Digest content = content_digest(archive);
    std::vector<TakeInfo> infos;
    std::vector<LibraryTake> takes;
    std::vector<std::size_t> missing;
    for (auto& [info, key] : keyed_takes(archive, setup.joint_map)) {
      infos.push_back(std::move(info));
      takes.emplace_back().key = key;
    }
    for (std::size_t i = 0; i < infos.size(); ++i) {
      takes[i].name = infos[i].name;
      takes[i].subject = infos[i].subject;
      takes[i].seconds = infos[i].seconds();
      const auto known = std::lower_bound(cached.begin(), cached.end(), takes[i], by_key);
      if (known != cached.end() && known->key == takes[i].key) {
        takes[i].track = known->track;
      } else {
        missing.push_back(i);
      }
    }
    const auto keep_what_is_known = [&] {
      for (const std::size_t i : missing) {
        if (takes[i].track.frames() > 0) cached.push_back(takes[i]);
      }
      std::sort(cached.begin(), cached.end(), by_key);
    };
    try {
      Decoding(archive, setup.joint_map, infos, takes, missing).run(setup.jobs, progress);
    } catch (const Error& error) {
      // A take that went away is no damage.
      const bool interrupted = error.code() == ErrorCode::interrupted;
      if (interrupted || attempt == most_attempts || content_digest(archive) == content) throw;
      keep_what_is_known();
      continue;
    }
    // Rows of takes are never changed in place, but a number may be given again after a removal.
    if (attempt == most_attempts || content_digest(archive) == content) return takes;
    keep_what_is_known();
  }
}

}  // namespace reprise

// What an open archive keeps at hand: spaces and proportions, decoded once.
#pragma once

#include <map>

#include "query/stored_forms.h"
#include "reprise/archive.h"
#include "store/archive_store.h"

namespace reprise {

struct OpenArchive {
  explicit OpenArchive(const std::filesystem::path& path)
      : store(ArchiveStore::open_for_reading(path)) {}

  /// One state of the archive for as long as it lives. What is at hand from another state is
  /// forgotten: a number may be given again after a removal.
  ArchiveStore::Snapshot snapshot() {
    ArchiveStore::Snapshot snapshot = store.snapshot();
    const std::int64_t now = store.state_number();
    if (now != state) {
      spaces.clear();
      known_values_read.clear();
      proportions_read.clear();
    }
    state = now;
    return snapshot;
  }

  const CodedSpace& space(std::int64_t id) {
    const auto known = spaces.find(id);
    return known != spaces.end() ? known->second
                                 : spaces.emplace(id, read_space(store, id)).first->second;
  }
  /// Of a space whose skeleton has so many channels; its axes are not decoded.
  const KnownValues& known_values(std::int64_t space, std::size_t channels) {
    const auto known = known_values_read.find(space);
    return known != known_values_read.end()
               ? known->second
               : known_values_read.emplace(space, read_known_values(store, space, channels))
                     .first->second;
  }
  const ProportionsRecord& proportions(std::int64_t id) {
    const auto known = proportions_read.find(id);
    return known != proportions_read.end()
               ? known->second
               : proportions_read.emplace(id, read_proportions(store, id)).first->second;
  }

  ArchiveStore store;
  std::int64_t state = 0;
  std::map<std::int64_t, CodedSpace> spaces;
  std::map<std::int64_t, KnownValues> known_values_read;
  std::map<std::int64_t, ProportionsRecord> proportions_read;
};

struct Archive::Impl : OpenArchive {
  using OpenArchive::OpenArchive;
};

}  // namespace reprise

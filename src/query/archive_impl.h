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

  const CodedSpace& space(std::int64_t id) {
    const auto known = spaces.find(id);
    return known != spaces.end() ? known->second
                                 : spaces.emplace(id, read_space(store, id)).first->second;
  }
  const ProportionsRecord& proportions(std::int64_t id) {
    const auto known = proportions_read.find(id);
    return known != proportions_read.end()
               ? known->second
               : proportions_read.emplace(id, store.proportions(id)).first->second;
  }

  ArchiveStore store;
  std::map<std::int64_t, CodedSpace> spaces;
  std::map<std::int64_t, ProportionsRecord> proportions_read;
};

struct Archive::Impl : OpenArchive {
  using OpenArchive::OpenArchive;
};

}  // namespace reprise

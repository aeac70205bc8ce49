// Gives each new take a skeleton, proportions and a space, making what is not there yet.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "archive/take_fit.h"
#include "archive/take_identity.h"

namespace reprise {

struct SpaceAssignment {
  std::int64_t proportions = 0;
  std::int64_t space_id = 0;
  std::shared_ptr<const CodedSpace> space;
  std::optional<FittedTake> fitted;  ///< where training has fitted the take already
};

class SpaceBuilder {
 public:
  SpaceBuilder(ArchiveStore& store, const IngestOptions& options)
      : store_(store), options_(options) {}

  /// One assignment a take, by name. Stores skeletons, proportions and spaces in one transaction.
  std::map<std::string, SpaceAssignment> build(const std::vector<FreshTake>& takes,
                                               const std::function<void(const std::string&)>& tick);

 private:
  using Members =
      std::vector<std::size_t>;  // indices of takes with one skeleton structure, by name

  void build_for_skeleton(const Members& members);
  std::shared_ptr<const CodedSpace> existing_space(std::int64_t skeleton, std::int64_t& id);
  void make_space(std::int64_t skeleton, const Members& members);
  void extend_where_needed(const Members& members, const CodedSpace& base, std::int64_t base_id);

  ArchiveStore& store_;
  const IngestOptions& options_;
  const std::vector<FreshTake>* takes_ = nullptr;
  std::map<std::string, SpaceAssignment> assignments_;
};

}  // namespace reprise

// Gives each new take a skeleton, proportions and a space, making what is not there yet.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "archive/space_trainer.h"

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

  /// One assignment a take, by name. Stores skeletons, proportions and spaces, in one transaction a
  /// skeleton structure. `tick` is called without a name, too, only to ask whether to go on.
  std::map<std::string, SpaceAssignment> build(const std::vector<FreshTake>& takes,
                                               const std::function<void(const std::string&)>& tick);

  /// For takes that no markers keep within their fidelity: a space in which every channel is coded
  /// as it is.
  std::map<std::string, SpaceAssignment> build_plain(
      const std::vector<FreshTake>& takes,
      const std::map<std::string, SpaceAssignment>& assignments);

 private:
  using Members = SpaceTrainer::Members;

  void build_for_skeleton(const Members& members, SpaceTrainer& trainer);
  std::int64_t skeleton_of(const Members& members);
  void assign_proportions(std::int64_t skeleton, const Members& members);
  void assign_space(std::int64_t id, const Members& members);
  /// Of takes that training has fitted.
  void assign_fits(SpaceTrainer& trainer);
  /// Takes that the space assigned to them leaves too far off.
  Members members_outside(const Members& members) const;
  /// The space that later takes join: the newest that goes through markers; 0 where there is none.
  std::int64_t newest_space(std::int64_t skeleton);
  std::int64_t plain_space(std::int64_t skeleton);

  ArchiveStore& store_;
  const IngestOptions& options_;
  std::function<void(const std::string&)> tick_;
  const std::vector<FreshTake>* takes_ = nullptr;
  std::map<std::string, SpaceAssignment> assignments_;
};

}  // namespace reprise

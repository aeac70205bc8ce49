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

  /// One assignment a take, by name. Stores skeletons, proportions and spaces, in one transaction a
  /// skeleton structure.
  std::map<std::string, SpaceAssignment> build(const std::vector<FreshTake>& takes,
                                               const std::function<void(const std::string&)>& tick);

  /// For takes that no markers keep within their fidelity: a space in which every channel is coded
  /// as it is.
  std::map<std::string, SpaceAssignment> build_plain(
      const std::vector<FreshTake>& takes,
      const std::map<std::string, SpaceAssignment>& assignments);

 private:
  using Members =
      std::vector<std::size_t>;  // indices of takes with one skeleton structure, by name

  void build_for_skeleton(const Members& members);
  std::int64_t skeleton_of(const Members& members);
  void assign_proportions(std::int64_t skeleton, const Members& members);
  void assign_space(std::int64_t id, const Members& members);
  void extend_where_needed(std::int64_t skeleton, const Members& members);
  MarkerMoments moments_of(const MarkerLayout& layout, const Members& members, bool every_frame);
  /// The space that later takes join: the newest that goes through markers; 0 where there is none.
  std::int64_t newest_space(std::int64_t skeleton);
  std::int64_t plain_space(std::int64_t skeleton);
  SpaceRecord train(std::int64_t skeleton, const Members& members);
  /// What the coder learns from some of the `training` takes, where that pays for `all` takes.
  std::vector<std::uint8_t> train_prior(const CoefficientSpace& space, const Members& training,
                                        std::size_t all);
  KnotScales measure_scales(const CoefficientSpace& space, const Members& members,
                            double takes_each);
  std::vector<std::uint8_t> cheaper_prior(const KnotScales& scales, double takes_each) const;
  void keep_fits(std::int64_t space);

  ArchiveStore& store_;
  const IngestOptions& options_;
  const std::vector<FreshTake>* takes_ = nullptr;
  std::function<void(const std::string&)> tick_;
  std::map<std::string, SpaceAssignment> assignments_;
  std::map<std::size_t, FittedTake> fits_;  // made on the way to a prior
};

}  // namespace reprise

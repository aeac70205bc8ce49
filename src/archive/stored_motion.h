// Takes that an archive holds already, for what looks for repeats of them.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "archive/take_identity.h"
#include "query/archive_impl.h"
#include "rma/postures.h"

namespace reprise {

/// Postures in a take and the size of the body (mm), with which they are compared to others.
struct MovingBody {
  PostureMatrix postures;
  double size = 0;
};

MovingBody moving_body(const Take& take, const RootAxis& root, double rate);

struct StoredMotion {
  TakeInfo take;
  std::vector<ClipInfo> clips;  ///< one at least
  MovingBody body;              ///< of the coarsest layer
};

class StoredMotionReader {
 public:
  /// Leaves out the stored takes that `fresh` ones replace.
  StoredMotionReader(const std::filesystem::path& archive, const std::vector<FreshTake>& fresh);

  std::int64_t skeleton_of(std::int64_t proportions);
  /// Of the first space of a skeleton, as all that compares postures has it.
  RootAxis root_of(std::int64_t skeleton);
  std::int64_t greatest_group() const;
  /// At most `most` takes of a skeleton, by name: those with primary clips before others. Throws
  /// Error (damaged).
  std::vector<StoredMotion> motions(std::int64_t skeleton, const RootAxis& root, double rate,
                                    std::size_t most);

 private:
  OpenArchive archive_;
  std::vector<StoredMotion> all_;  ///< without postures
};

}  // namespace reprise

#include "query/posture_library.h"

#include <utility>

#include "query/take_decoder.h"

namespace reprise {

SkeletonPostures read_postures(OpenArchive& archive, std::vector<TakeInfo> takes,
                               const RootAxis& root, const RepeatConstants& constants,
                               const std::function<void(const TakeInfo&)>& tick) {
  std::vector<PostureMatrix> postures;
  postures.reserve(takes.size());
  for (const TakeInfo& take : takes) {
    tick(take);
    const Take decoded = decode_layer(archive, archive.store.take(take.id), 0);
    postures.push_back(aligned_postures(decoded, root, constants.rate));
  }
  return {std::move(takes), PostureLibrary(std::move(postures), constants)};
}

}  // namespace reprise

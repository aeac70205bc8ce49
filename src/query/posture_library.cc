#include "query/posture_library.h"

#include <cassert>
#include <utility>

#include "query/take_decoder.h"

namespace reprise {

SkeletonPostures read_postures(OpenArchive& archive, std::vector<TakeInfo> takes,
                               const RootAxis& root, const RepeatConstants& constants,
                               const std::function<void(const TakeInfo&)>& tick) {
  std::vector<PostureMatrix> postures;
  postures.reserve(takes.size());
  std::vector<double> sizes;
  for (const TakeInfo& take : takes) {
    tick(take);
    const Take decoded = decode_layer(archive, archive.store.take(take.id), 0);
    postures.push_back(aligned_postures(decoded, root, constants.rate));
    sizes.push_back(body_size(decoded, root));
  }
  std::vector<float> factors = bring_to_median_size(postures, sizes);
  PostureLibrary library(std::move(postures), constants);
  library.narrow_to_reach(constants);
  return {std::move(takes), std::move(factors), std::move(library)};
}

float own_size_distance(const SkeletonPostures& postures, const Occurrence& reference,
                        const Occurrence& occurrence) {
  const PostureMatrix& from = postures.library.postures[reference.take];
  const PostureMatrix& to = postures.library.postures[occurrence.take];
  assert(occurrence.map.size() == static_cast<std::size_t>(reference.end - reference.begin));
  float sum = 0;
  for (std::size_t s = 0; s < occurrence.map.size(); ++s) {
    const Eigen::RowVectorXf a =
        from.row(reference.begin + static_cast<long>(s)) / postures.factors[reference.take];
    const Eigen::RowVectorXf b = to.row(occurrence.map[s]) / postures.factors[occurrence.take];
    sum += mean_joint_distance(a.data(), b.data(), a.cols());
  }
  return sum / static_cast<float>(occurrence.map.size());
}

}  // namespace reprise

#include "query/skeleton_postures.h"

#include <cassert>
#include <mutex>
#include <utility>

#include "model/free_memory.h"
#include "model/memory_budget.h"
#include "query/take_decoder.h"
#include "rma/parallel_for.h"

namespace reprise {

SkeletonPostures read_postures(OpenArchive& archive, std::vector<TakeInfo> takes,
                               const RootAxis& root, const RepeatConstants& constants,
                               unsigned jobs, const std::function<void(const TakeInfo&)>& tick) {
  std::vector<PostureMatrix> postures(takes.size());
  std::vector<double> sizes(takes.size());
  std::mutex reading;
  MemoryBudget memory(free_memory());
  parallel_for(takes.size(), jobs, [&](std::size_t t) {
    const auto share = memory.take(decoding_memory(takes[t]));
    const StoredLayer stored = [&] {
      const std::lock_guard lock(reading);
      tick(takes[t]);
      return read_layer(archive, archive.store.take(takes[t].id), 0);
    }();
    const Take decoded = decode_layer(stored);
    postures[t] = aligned_postures(decoded, root, constants.rate);
    sizes[t] = body_size(decoded, root);
  });
  std::vector<float> factors = bring_to_median_size(postures, sizes);
  PostureLibrary library(std::move(postures), constants);
  library.follow_reach(constants, jobs);
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

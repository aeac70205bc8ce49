#include "rma/posture_library.h"

#include <algorithm>
#include <utility>

#include "rma/posture_reach.h"

namespace reprise {

PostureLibrary::PostureLibrary(std::vector<PostureMatrix> takes, const RepeatConstants& constants)
    : postures(std::move(takes)) {
  const PostureBasis basis(postures, constants.axes);
  for (const PostureMatrix& take : postures) {
    projected.push_back(basis.project(take));
    similar_mm.emplace_back(static_cast<std::size_t>(take.rows()), constants.similar_mm);
    similar_across_mm.emplace_back(static_cast<std::size_t>(take.rows()),
                                   constants.across_subjects * constants.similar_mm);
  }
}

void PostureLibrary::follow_reach(const RepeatConstants& constants, unsigned jobs) {
  const auto reaches = posture_reaches(projected, constants.reach_part, jobs);
  for (std::size_t take = 0; take < takes(); ++take) {
    for (std::size_t s = 0; s < reaches[take].size(); ++s) {
      const float reach = reaches[take][s];
      similar_mm[take][s] = similar_at_reach(reach, constants);
      similar_across_mm[take][s] = similar_at_reach(reach, constants, constants.across_subjects);
    }
  }
}

bool PostureLibrary::of_one_subject(std::size_t take, std::size_t other) const {
  return subjects.empty() || subjects[take] == subjects[other];
}

const std::vector<float>& PostureLibrary::similar(std::size_t take, std::size_t other) const {
  return of_one_subject(take, other) ? similar_mm[take] : similar_across_mm[take];
}

PostureView PostureLibrary::view(std::size_t take, long begin, long end) const {
  return {postures[take].middleRows(begin, end - begin),
          projected[take].middleRows(begin, end - begin)};
}

}  // namespace reprise

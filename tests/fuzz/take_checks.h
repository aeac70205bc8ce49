// What holds of every take that a parser accepts.
#pragma once

#include <cmath>

#include "fuzz/fuzz_input.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "reprise/model/measure.h"
#include "reprise/query/body_joints.h"
#include "reprise/query/key_poses.h"

namespace reprise {

inline void expect_refusal(const Error& error) {
  expect(error.code() == ErrorCode::rejected_input && !error.reason().empty(), error.what());
}

/// `again` is of the source text of `skeleton`.
inline void check_skeleton_text(const Skeleton& skeleton, const Skeleton& again) {
  expect(same_structure(skeleton, again), "a skeleton's text gives it again");
}

/// Written with six decimals and read again, a take has the same frames and nearly the same
/// numbers; what is measured of it is finite.
template <class Read>
void check_written(const Take& take, const Read& read) {
  const std::string written = write_motion(take);
  try {
    const Take again = read(written);
    expect(again.frames() == take.frames(), "a written take has as many frames");
    expect(again.channels.cols() == take.channels.cols(), "a written take has as many channels");
    if (take.channels.size() > 0) {
      // Half of the last decimal, and what degrees lose on their way through radians.
      const double most = take.layout.radians ? 1e-4 : 1e-6;
      const auto differences = (again.channels - take.channels).array().abs();
      expect((differences <= most + 1e-12 * take.channels.array().abs()).all(),
             "a written take has the same numbers");
    }
    const Comparison comparison = compare_takes(take, again);
    expect(std::isfinite(comparison.errors.max), "what is measured is finite");
  } catch (const Error& error) {
    expect(false, std::string("a written take is accepted: ") + error.what());
  }
  match_body(*take.skeleton);
  if (take.frames() > 0) key_poses(take);
}

}  // namespace reprise

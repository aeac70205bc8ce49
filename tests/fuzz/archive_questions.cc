#include "fuzz/archive_questions.h"

#include "reprise/archive.h"
#include "reprise/error.h"
#include "reprise/query/key_poses.h"
#include "reprise/query/motion_search.h"
#include "reprise/self_distance.h"

namespace reprise {
namespace {

/// Damage to a take is no reason to leave the others out.
template <class Question>
void ask(const Question& question) {
  try {
    question();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::damaged && error.code() != ErrorCode::usage &&
        error.code() != ErrorCode::not_found)
      throw;
  }
}

void ask_tables(const Archive& archive) {
  ask([&] { archive.clips(); });
  ask([&] { archive.subjects(); });
  ask([&] { archive.skeletons(); });
  ask([&] { archive.info(); });
  for (const TakeInfo& info : archive.takes()) {
    ask([&] { archive.find(info.name); });
    ask([&] { archive.takes({.text = info.subject}); });
  }
  for (const ClipInfo& clip : archive.clips()) ask([&] { archive.find(clip.id); });
}

void ask_motion(const Archive& archive) {
  for (const TakeInfo& info : archive.takes()) {
    ask([&] { archive.source_text(info); });
    ask([&] { archive.extract(info, {0, 1}, FidelityTier::preview); });
    ask([&] {
      const Take take = archive.extract(info);
      write_motion(take);
      if (take.frames() > 0) key_poses(take);
    });
  }
}

void ask_repeats(const Archive& archive) {
  ask([&] { archive.repeats({.jobs = 1}); });
  for (const TakeInfo& info : archive.takes()) ask([&] { self_distance(archive, info); });
}

void ask_search(const Archive& archive, const std::filesystem::path& path) {
  MotionSearch search(path, {.jobs = 1});
  for (const TakeInfo& info : archive.takes()) ask([&] { search.like(info); });
}

}  // namespace

void ask_archive(const std::filesystem::path& path, Questions questions) {
  const Archive archive(path);
  switch (questions) {
    case Questions::tables:
      return ask([&] { ask_tables(archive); });
    case Questions::verify:
      return ask([&] { archive.verify(); });
    case Questions::motion:
      return ask([&] { ask_motion(archive); });
    case Questions::repeats:
      return ask([&] { ask_repeats(archive); });
    case Questions::search:
      return ask([&] { ask_search(archive, path); });
  }
}

}  // namespace reprise

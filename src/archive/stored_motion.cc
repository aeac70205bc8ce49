#include "archive/stored_motion.h"

#include <algorithm>

#include "query/clip_info.h"
#include "query/take_decoder.h"
#include "reprise/error.h"

namespace reprise {
namespace {

bool has_primary(const StoredMotion& motion) {
  return std::ranges::any_of(motion.clips,
                             [](const ClipInfo& clip) { return clip.kind == ClipKind::primary; });
}

}  // namespace

MovingBody moving_body(const Take& take, const RootAxis& root, double rate) {
  return {aligned_postures(take, root, rate), body_size(take, root)};
}

StoredMotionReader::StoredMotionReader(const std::filesystem::path& archive,
                                       const std::vector<FreshTake>& fresh)
    : archive_(archive) {
  std::set<std::string> replaced;
  for (const FreshTake& take : fresh) {
    if (take.replaces) replaced.insert(take.file.name);
  }
  for (TakeInfo& take : archive_.store.takes({})) {
    if (replaced.contains(take.name)) continue;
    const std::int64_t ids[] = {take.id};
    StoredMotion motion;
    for (const ClipRecord& record : archive_.store.clips(ids))
      motion.clips.push_back(clip_info(record, take));
    motion.take = std::move(take);
    if (!motion.clips.empty()) all_.push_back(std::move(motion));
  }
}

std::int64_t StoredMotionReader::skeleton_of(std::int64_t proportions) {
  return archive_.proportions(proportions).skeleton;
}

RootAxis StoredMotionReader::root_of(std::int64_t skeleton) {
  const std::vector<std::int64_t> spaces = archive_.store.spaces_of_skeleton(skeleton);
  if (spaces.empty()) throw Error(ErrorCode::damaged, "the archive is damaged: axes are missing");
  const LayoutChoices& choices = archive_.space(spaces.front()).space.layout.choices;
  return {choices.root_joint, choices.up_axis};
}

std::int64_t StoredMotionReader::greatest_group() const {
  std::int64_t greatest = 0;
  for (const StoredMotion& motion : all_) {
    for (const ClipInfo& clip : motion.clips) greatest = std::max(greatest, clip.group);
  }
  return greatest;
}

std::vector<StoredMotion> StoredMotionReader::motions(std::int64_t skeleton, const RootAxis& root,
                                                      double rate, std::size_t most) {
  std::vector<StoredMotion> chosen;
  for (const StoredMotion& motion : all_) {
    if (motion.take.skeleton == skeleton) chosen.push_back(motion);
  }
  std::stable_partition(chosen.begin(), chosen.end(), has_primary);
  if (chosen.size() > most) chosen.resize(most);
  std::ranges::sort(chosen, {}, [](const StoredMotion& motion) { return motion.take.name; });
  for (StoredMotion& motion : chosen) {
    const Take take = decode_layer(archive_, archive_.store.take(motion.take.id), 0);
    motion.body = moving_body(take, root, rate);
  }
  return chosen;
}

}  // namespace reprise

// A small archive with something in every table.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "reprise/error.h"
#include "store/archive_store.h"
#include "store/digest.h"

namespace reprise {

namespace fs = std::filesystem;

class StoreTest : public testing::Test {
 protected:
  StoreTest() {
    std::string pattern = (fs::temp_directory_path() / "reprise-store-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    path_ = folder_ / "archive.rpz";
  }
  ~StoreTest() override { fs::remove_all(folder_); }

  fs::path folder_;
  fs::path path_;
};

inline Bytes random_bytes(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// Rows that takes need, made once in an archive.
struct Ground {
  std::int64_t skeleton = 0, proportions = 0, space = 0;
};

inline Ground lay_ground(ArchiveStore& store) {
  Ground ground;
  SkeletonRecord skeleton;
  skeleton.structure = digest_of("structure");
  skeleton.joints = 20;
  skeleton.channels = 60;
  skeleton.root = "Hips";
  ground.skeleton = store.add_skeleton(skeleton);
  ProportionsRecord proportions;
  proportions.skeleton = ground.skeleton;
  proportions.frame_rate = 120;
  proportions.frame_rate_assumed = true;
  proportions.asf_name = "01";
  proportions.layout = {1, 2, 3};
  for (int i = 0; i < 200; ++i)
    proportions.source_text += "bone " + std::to_string(i * 7919 % 1000) + "\n";
  ground.proportions = store.add_proportions(proportions);
  ground.space = store.add_space({0, ground.skeleton, 0, random_bytes(300, 9)});
  return ground;
}

inline TakeRecord sample_take(const Ground& ground, int number) {
  TakeRecord take;
  const auto seed = static_cast<unsigned>(number);
  take.info.name = "walks/" + std::to_string(number % 3) + "/take_" + std::to_string(number);
  take.info.subject = "subject " + std::to_string(number % 2);
  take.info.description = number % 2 ? "a person walks, take " + std::to_string(number) : "";
  take.info.frames = 100 + number;
  take.info.text_bytes = 5000;
  take.info.error_mm = {19.5, 22.25, 60.125, 99.5};
  take.info.rotation_deg = {1.5, 6.25, 9.875};
  take.info.worst_place = {3, 17};
  take.info.worst_turn = {5, 40};
  take.turn_quantiles = {1, 2, 4, 8};
  take.info.source_digest = hexadecimal(digest_of("source " + std::to_string(number)));
  take.proportions = ground.proportions;
  take.space = ground.space;
  take.error_quantiles = {1, 2, 3, 4, 5, 6, 7, 8};
  take.layers = {{LayerKind::coefficients, 20.0, 0.0, random_bytes(200 + 10 * seed, seed)},
                 {LayerKind::refinement, 10.0, 5.0, random_bytes(300 + 10 * seed, seed + 1)}};
  take.spent = {{"curves", take.layers[0].data.size()}, {"refinement", take.layers[1].data.size()}};
  return take;
}

inline ClipRecord sample_clip(int number) {
  ClipRecord clip;
  clip.id = 0x123456789abcdef0u * static_cast<std::uint64_t>(number + 1);
  clip.frames = 100 + number;
  return clip;
}

/// Two of three takes are one clip; the others have two, of which one may repeat the other.
inline std::vector<ClipRecord> sample_clips(int number) {
  std::vector<ClipRecord> clips = {sample_clip(number)};
  if (number % 3 == 1) {
    clips[0].frames = 40;
    ClipRecord part = sample_clip(number + 1000);
    part.group = 1 + number % 4;
    if (number % 2 != 0) {
      clips[0].kind = ClipKind::primary;
      part.kind = ClipKind::repeated;
      part.primary = clips[0].id;
    }
    part.first_frame = 40;
    part.frames = 60 + number;
    clips.push_back(part);
  }
  return clips;
}

inline void add_sample(ArchiveStore& store, const Ground& ground, int number) {
  store.add_take(sample_take(ground, number), sample_clips(number));
}

inline Ground make_sample(const fs::path& path, int takes) {
  ArchiveStore store = ArchiveStore::open_for_writing(path);
  store.begin();
  const Ground ground = lay_ground(store);
  for (int i = 0; i < takes; ++i) add_sample(store, ground, i);
  store.commit();
  return ground;
}

/// Everything that an archive answers, as one text.
inline std::string everything(const ArchiveStore& store) {
  std::string text;
  for (const TakeInfo& info : store.takes({})) {
    const TakeRecord take = store.take(info.id);
    for (const std::string& part :
         {info.name, info.subject, info.description, std::to_string(info.frames),
          std::to_string(info.frame_rate), std::to_string(info.error_mm.max), info.source_digest,
          hexadecimal(store.layer(info.id, 0)), hexadecimal(store.layer(info.id, 1)),
          hexadecimal(take.error_quantiles), hexadecimal(store.space(take.space).data),
          store.proportions(take.proportions).source_text}) {
      text += part;
      text += '|';
    }
    const std::int64_t ids[] = {info.id};
    for (const ClipRecord& clip : store.clips(ids)) {
      for (const auto fact : {clip.take, std::int64_t{clip.first_frame}, std::int64_t{clip.frames},
                              std::int64_t{static_cast<int>(clip.kind)}, clip.group})
        text += std::to_string(fact) + ":";
      text += std::to_string(clip.id) + ":" + std::to_string(clip.primary) + "|";
      text += std::to_string(
          store.clips_with_prefix(hexadecimal(Bytes{static_cast<std::uint8_t>(clip.id >> 56)}))
              .size());
    }
    text += std::to_string(store.find_take(info.name).has_value()) + "\n";
  }
  for (const SkeletonInfo& skeleton : store.skeletons())
    text += skeleton.root + std::to_string(skeleton.takes);
  for (const std::string& subject : store.subjects()) text += subject;
  text += std::to_string(store.takes({"", "", "walks", {}}).size());
  return text + hexadecimal(store.content_digest());
}

inline std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

inline ErrorCode code_when_opened(const fs::path& path) {
  try {
    everything(ArchiveStore::open_for_reading(path));
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode{0};
}

}  // namespace reprise

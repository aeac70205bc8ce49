// Records that are whole, as their digests say, and do not fit each other: somebody made them so.
#include <set>

#include "archive/archive_fixture.h"
#include "exact/text_codec.h"
#include "quant/take_header.h"
#include "query/stored_forms.h"
#include "refine/coarse_channels.h"
#include "refine/coded_channels.h"
#include "refine/refinement.h"
#include "reprise/error.h"
#include "store/archive_store.h"

namespace reprise {
namespace {

/// A chain of joints below a root that moves through space.
std::string chain_bvh(int joints, int frames) {
  std::string text =
      "HIERARCHY\nROOT r\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation "
      "Xrotation Yrotation\n";
  for (int j = 0; j < joints; ++j) {
    text += "JOINT j" + std::to_string(j) +
            "\n{\nOFFSET 0 10 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
  }
  text += "End Site\n{\nOFFSET 0 10 0\n}\n";
  for (int j = 0; j <= joints; ++j) text += "}\n";
  text += "MOTION\nFrames: " + std::to_string(frames) + "\nFrame Time: 0.02\n";
  for (int f = 0; f < frames; ++f) {
    for (int c = 0; c < 6 + 3 * joints; ++c)
      text += std::to_string(f * (c % 5 + 1) % 40) + (c + 1 < 6 + 3 * joints ? " " : "\n");
  }
  return text;
}

class FalseRecords : public ArchiveTest {
 protected:
  FalseRecords() {
    write("takes/long.bvh", chain_bvh(8, 40));
    write("takes/short.bvh", chain_bvh(1, 40));
    EXPECT_EQ(add("archive", {"takes"}).added.size(), 2u);
    store_.emplace(ArchiveStore::open_for_writing(folder_ / "archive"));
    store_->begin();
    long_ = record("long");
    short_ = record("short");
  }

  TakeRecord record(const std::string& name) {
    TakeRecord record = *store_->find_take(name);
    for (std::size_t i = 0; i < record.layers.size(); ++i)
      record.layers[i].data = store_->layer(record.info.id, i);
    return record;
  }

  /// The data of a layer of `short_`, behind its header.
  Bytes layer_of(const Take& take, const TakeHeader& header, const Bytes& data) const {
    const auto channels = static_cast<std::size_t>(take.skeleton->channel_count);
    return join_header(*take.skeleton, read_known_values(*store_, short_.space, channels),
                       take.frames(), header, data);
  }

  /// Stores the record as a take of its own, and reads it.
  void expect_damage(TakeRecord record, const std::string& what) {
    ClipRecord clip;
    clip.frames = record.info.frames;
    record.info.name = "false";
    store_->add_take(record, std::span(&clip, 1));
    store_->commit();
    store_.reset();
    const Archive archive(folder_ / "archive");
    try {
      archive.extract(archive.find_take("false"));
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::damaged) << what << ": " << error.what();
    }
    EXPECT_EQ(archive.extract(archive.find_take("long")).frames(), 40);
    EXPECT_FALSE(archive.verify().ok) << what;
  }

  std::optional<ArchiveStore> store_;
  TakeRecord long_, short_;
};

TEST_F(FalseRecords, AxesOfAnotherSkeletonAreDamage) {
  short_.space = long_.space;
  expect_damage(short_, "the axes of another skeleton");
}

TEST_F(FalseRecords, ProportionsOfAnotherStructureAreDamage) {
  ProportionsRecord proportions = store_->proportions(short_.proportions);
  proportions.skeleton = store_->proportions(long_.proportions).skeleton;
  long_.proportions = store_->add_proportions(proportions);
  expect_damage(long_, "the text of another skeleton");
}

TEST_F(FalseRecords, UnitsThatNobodyMeasuresInAreDamage) {
  ProportionsRecord proportions = store_->proportions(short_.proportions);
  proportions.millimetres_per_unit = 1e200;
  short_.proportions = store_->add_proportions(proportions);
  expect_damage(short_, "a unit of 1e197 m");
}

TEST_F(FalseRecords, NumbersThatNoMotionHasAreDamage) {
  const Take take = read_motion_file(folder_ / "takes/short.bvh");
  const TakeHeader header = prepare_take(take).header;
  CodedChannels channels(*take.skeleton, header.constants, {take.frames(), take.frame_rate},
                         {0, 0});
  std::ranges::fill(channels.steps.base, -1);
  channels.stored = Eigen::MatrixXd::Constant(take.frames(), channels.knots.cols(), 1e300);
  short_.layers.push_back(
      {LayerKind::refinement, 10.0, 10.0, layer_of(take, header, channels.encode())});
  expect_damage(short_, "a joint at 1e300");
}

TEST_F(FalseRecords, ChannelsThatBreakTheirMeanAreFound) {
  const Take take = read_motion_file(folder_ / "takes/short.bvh");
  const PreparedTake prepared = prepare_take(take);
  const Refinement coarse = coarse_channels(prepared, {20, true, 1u << 20}).value();
  const Bytes layer = layer_of(take, prepared.header, coarse.bytes);
  ClipRecord clip;
  clip.frames = take.frames();
  for (const auto& [name, limit] : {std::pair{"kept", 20.0}, std::pair{"broken", 1e-3}}) {
    write(std::string("takes/") + name + ".bvh", chain_bvh(1, 40));
    short_.info.name = name;
    short_.layers = {{LayerKind::channels, limit, 0.0, layer}};
    store_->add_take(short_, std::span(&clip, 1));
  }
  store_->commit();
  store_.reset();
  const Archive archive(folder_ / "archive");
  EXPECT_TRUE(archive.extract(archive.find_take("kept")).channels ==
              restore_take(*take.skeleton, prepared.header, coarse.decoded));
  std::vector<std::string> damaged;
  for (const Damage& damage : archive.verify(folder_ / "takes").damaged)
    damaged.push_back(damage.id);
  EXPECT_EQ(damaged, std::vector<std::string>{"broken"});
}

TEST_F(FalseRecords, TurnsThatBreakTheirBoundAreFound) {
  const Take take = read_motion_file(folder_ / "takes/short.bvh");
  const PreparedTake prepared = prepare_take(take);
  const Bytes layer = layer_of(take, prepared.header, refine(prepared, {10, 10}).bytes);
  ClipRecord clip;
  clip.frames = take.frames();
  for (const auto& [name, degrees] : {std::pair{"kept", 10.0}, std::pair{"broken", 0.001}}) {
    write(std::string("takes/") + name + ".bvh", chain_bvh(1, 40));
    short_.info.name = name;
    short_.layers = {{LayerKind::refinement, 10.0, degrees, layer}};
    store_->add_take(short_, std::span(&clip, 1));
  }
  store_->commit();
  store_.reset();
  std::vector<std::string> damaged;
  for (const Damage& damage : Archive(folder_ / "archive").verify(folder_ / "takes").damaged) {
    damaged.push_back(damage.id);
    EXPECT_NE(damage.why.find("degrees"), std::string::npos) << damage.why;
  }
  EXPECT_EQ(damaged, std::vector<std::string>{"broken"});
}

TEST_F(FalseRecords, NamesThatLeadOutOfAFolderAreFound) {
  ClipRecord clip;
  clip.frames = short_.info.frames;
  const std::vector<std::string> names = {"../x",  "/x",   "a//x",
                                          "a/./x", "a/..", std::string("a\0b", 3)};
  for (const std::string& name : names) {
    short_.info.name = name;
    store_->add_take(short_, std::span(&clip, 1));
  }
  store_->commit();
  store_.reset();
  std::set<std::string> damaged;
  for (const Damage& damage : Archive(folder_ / "archive").verify().damaged)
    damaged.insert(damage.id);
  EXPECT_EQ(damaged, std::set<std::string>(names.begin(), names.end()));
}

TEST_F(FalseRecords, FramesThatNoTextHasAreDamage) {
  short_.info.frames = long{1} << 40;
  expect_damage(short_, "a trillion frames of few bytes");
}

TEST_F(FalseRecords, NoFramesAreDamage) {
  short_.info.frames = 0;
  expect_damage(short_, "no file without frames is taken in");
}

TEST_F(FalseRecords, TextsThatNoFileHasAreDamage) {
  short_.info.frames = long{1} << 40;
  short_.info.text_bytes = std::uint64_t{1} << 60;
  expect_damage(short_, "a text of an exabyte");
}

TEST_F(FalseRecords, TextsLongerThanTheyWereAreDamage) {
  // A few coded bytes can be any number of empty lines: what a text may take is known beforehand.
  const std::string text = chain_bvh(1, 40) + std::string(100'000, '\n');
  short_.layers.push_back(
      {LayerKind::text, 0.0, 0.0, encode_text(text, text.substr(0, text.find("MOTION")))});
  expect_damage(short_, "a text with lines that its file did not have");
}

TEST_F(FalseRecords, FramesThatNoLayerHoldsAreDamage) {
  short_.info.frames = 100'000'000;
  short_.info.text_bytes = InputLimits::file_bytes;
  const Take take = read_motion_file(folder_ / "takes/short.bvh");
  const TakeHeader header = prepare_take(take).header;
  const CodedChannels channels(*take.skeleton, header.constants, {take.frames(), take.frame_rate},
                               {0, 0});
  short_.layers = {{LayerKind::refinement, 10.0, 10.0, layer_of(take, header, channels.encode())}};
  expect_damage(short_, "many frames of a refinement of few bytes");
}

TEST_F(FalseRecords, ClipsWithoutFramesAreNoHindrance) {
  // The first one of a take has no frames and the group of the one after it.
  std::vector<ClipRecord> clips(2);
  clips[1].frames = long_.info.frames;
  for (ClipRecord& clip : clips) clip.group = 5;
  for (const char* name : {"without/one", "without/two"}) {
    long_.info.name = name;
    store_->add_take(long_, clips);
  }
  store_->commit();
  store_.reset();
  write("more.bvh", chain_bvh(8, 90));
  EXPECT_EQ(add("archive", {"more.bvh"}).added.size(), 1u);
}

TEST_F(ArchiveTest, NamesAreGivenOnce) {
  // "x.bvh" is the first one's name, since "x" stands for two files, and the last one's.
  write("takes/x.bvh", chain_bvh(1, 5));
  write("takes/x.bvh.bvh", chain_bvh(2, 5));
  write("takes/sub/y.bvh", chain_bvh(1, 5));
  fs::create_directories(folder_ / "again");
  fs::rename(folder_ / "takes/sub/y.bvh", folder_ / "again/x.BVH");
  const IngestReport report = add("archive", {"takes", "again"});
  EXPECT_EQ(report.added.size() + report.rejected.size(), 3u);
  EXPECT_EQ(report.rejected.size(), 1u);
  EXPECT_TRUE(Archive(folder_ / "archive").verify().ok);
}

}  // namespace
}  // namespace reprise

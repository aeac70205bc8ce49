// Writes the inputs that fuzzers start from: bytes of real blocks, spaces and layers, and texts.
#include <fmt/format.h>

#include "fuzz/archive_questions.h"
#include "fuzz/sample_archive.h"
#include "fuzz/scratch_folder.h"
#include "reprise/query/motion_search.h"
#include "reprise/synth/library.h"
#include "store/database.h"

using namespace reprise;

namespace {

namespace fs = std::filesystem;

fs::path target_folder;

void seed(const char* fuzzer, const std::string& bytes) {
  static int number = 0;
  const fs::path folder = target_folder / fuzzer;
  fs::create_directories(folder);
  write_scratch(folder / fmt::format("seed{}", number++), bytes);
}

std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

void seed_from_archive() {
  const ArchiveStore store = ArchiveStore::open_for_reading(sample_archive());
  const std::vector<TakeRecord> records = sample_records(store);
  for (std::size_t take = 0; take < records.size(); ++take) {
    const char which = static_cast<char>(take);
    for (std::size_t l = 0; l < records[take].layers.size(); ++l) {
      seed("layer",
           std::string{which, static_cast<char>(l), 0, 0} + text_of(records[take].layers[l].data));
    }
    if (records[take].space != 0) {
      const SpaceRecord space = store.space(records[take].space);
      seed("space", std::string{which, static_cast<char>(space.base != 0)} + text_of(space.data));
    }
    for (char kind = 0; kind < 4; ++kind)
      seed("records", std::string{kind, 1, which, kind, 0, 3, 5, 0, 0, 1});
  }
  const Database database(sample_archive(), Database::Mode::read);
  Statement rows(database, "SELECT takes FROM blocks");
  while (rows.step()) seed("block", text_of(rows.bytes()));
  for (char questions = 0; questions < static_cast<char>(question_kinds); ++questions) {
    for (const char kind : {0, 1}) {
      seed("archive_file", std::string{questions, kind, 0, 1, 3, 9, 0, 0, 1});
    }
  }
}

/// Short takes of few joints, so that inputs are small.
constexpr const char* small_bvh =
    "HIERARCHY\nROOT Hips\n{\n\tOFFSET 0.0 0.0 0.0\n\tCHANNELS 6 Xposition Yposition Zposition "
    "Zrotation Xrotation Yrotation\n\tJOINT LeftFoot\n\t{\n\t\tOFFSET 1.5 -8 0\n\t\tCHANNELS 3 "
    "Zrotation Xrotation Yrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 0 "
    "4\n\t\t}\n\t}\n}\nMOTION\n"
    "Frames: 3\nFrame Time: 0.0333333\n0.0 9.5 0 0 0 0 1.25 -3 90\n"
    "0.1 9.5 1 10.5 -20 3 1.5 -3 91.0\n0.2 9.4 2 1e1 -2.5e+1 3 179.99 -3 -180\n";
constexpr const char* small_asf =
    "# made up\n:version 1.10\n:name VICON\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n"
    ":documentation\n  none\n:root\n  order TX TY TZ RX RY RZ\n  axis XYZ\n  position 0 0 0\n"
    "  orientation 0 0 0\n:bonedata\n  begin\n    id 1\n    name lhipjoint\n    direction 0.6 -0.7 "
    "0.3\n"
    "    length 2.4\n    axis 0 0 0 XYZ\n  end\n  begin\n    id 2\n    name lfoot\n"
    "    direction 0.3 -0.9 0\n    length 7.1\n    axis 0 0 20 XYZ\n    dof rx ry rz\n"
    "    limits (-160.0 20.0)\n           (-70.0 70.0)\n           (-60.0 70.0)\n  end\n"
    ":hierarchy\n  begin\n    root lhipjoint\n    lhipjoint lfoot\n  end\n";
constexpr const char* small_amc =
    "#!OML:ASF fuzz.asf\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot 9.3 17.8 -17.3 -2.0 -7.1 3.0\n"
    "lfoot 1 2 3\n2\nroot 9.4 17.8 -17.3 -2.1 -7.2 3.0\nlfoot 1.5 2 -179.5\n";

void seed_texts() {
  const std::string pair = std::string(small_asf) + '\0' + small_amc;
  seed("bvh", small_bvh);
  seed("amc", pair);
  for (char tier = 0; tier < 4; ++tier) {
    seed("ingest", tier + std::string(small_bvh));
    seed("ingest", tier + pair);
  }
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    SynthOptions options;
    options.takes = 1;
    options.seconds = 1;
    options.format = format;
    Take take = make_synthetic_library(options).takes.at(0);
    take.channels = ChannelMatrix(take.channels.topRows(std::min(6L, take.frames())));
    const std::string text = write_motion(take);
    seed("text", std::string(2, '\0') + text);
    seed("text", std::string{0, 2} + text.substr(0, 3000));
    if (format == MotionFormat::bvh) seed("bvh", text);
    if (format == MotionFormat::asf_amc) seed("amc", take.skeleton->source_text + '\0' + text);
  }
  seed("text", std::string(2, '\0') + small_bvh);
  seed("text", std::string(2, '\0') + small_amc);
  seed("tables", '\0' + std::string("hip_left = LThigh # left\n\nhead=Head\n"));
  seed("tables",
       '\0' + std::string("take,subject,description,tags\r\na/b,s1,\"x, \"\"y\"\"\",t\r\n"));
}

void seed_cache() {
  MotionSearch search(sample_archive(), {.write_cache = true, .jobs = 1});
  const std::string cache = read_scratch(search_cache_path(sample_archive()));
  seed("tables", '\1' + cache.substr(0, cache.size() - 8));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  target_folder = arguments[1];
  seed_from_archive();
  seed_texts();
  seed_cache();
  return 0;
}

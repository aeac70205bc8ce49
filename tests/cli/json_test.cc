// The documents of --json: exactly the promised fields, with the right types.
#include <set>

#include "cli/command_runner.h"

namespace reprise::cli {
namespace {

using nlohmann::json;

/// Field names with their JSON types, nested: "number" takes whole numbers and others.
const json error_shape = {
    {"mean", "number"}, {"rms", "number"}, {"p99", "number"}, {"max", "number"}};
const json turns_shape = {{"mean", "number"}, {"p99", "number"}, {"max", "number"}};
const json worst_shape = {{"joint", "string"}, {"frame", "integer"}, {"time", "number"}};
const json worst_error_shape = {
    {"take", "string"}, {"joint", "string"}, {"frame", "integer"}, {"time", "number"}};
const json stats_shape = {
    {"takes", "integer"},
    {"frames", "integer"},
    {"seconds", "number"},
    {"subjects", "integer"},
    {"skeletons", "integer"},
    {"groups", "integer"},
    {"clips", {{"primary", "integer"}, {"repeated", "integer"}, {"unique", "integer"}}},
    {"raw_bytes", "integer"},
    {"text_bytes", "integer"},
    {"archive_bytes", "integer"},
    {"payload_bytes", "integer"},
    {"bytes", "counts"},
    {"ratio", {{"raw", "number"}, {"text", "number"}}},
    {"error_mm", error_shape},
    {"rotation_deg", turns_shape},
    {"worst_place", worst_error_shape},
    {"worst_turn", worst_error_shape},
    {"fidelity", "counts"}};
const json take_shape = {{"id", "string"},
                         {"name", "string"},
                         {"subject", "string"},
                         {"format", "string"},
                         {"frames", "integer"},
                         {"frame_rate", "number"},
                         {"seconds", "number"},
                         {"fidelity", "string"},
                         {"unit_mm", "number"},
                         {"unit_assumed", "boolean"},
                         {"up", "string"},
                         {"up_assumed", "boolean"},
                         {"raw_bytes", "integer"},
                         {"payload_bytes", "integer"},
                         {"error_mm", error_shape},
                         {"rotation_deg", turns_shape},
                         {"limit_mm", "number"},
                         {"limit_deg", "number"},
                         {"worst_place", worst_shape},
                         {"worst_turn", worst_shape}};
const json clip_shape = {{"id", "string"},           {"take", "string"},    {"kind", "string"},
                         {"group", "integer"},       {"start", "number"},   {"end", "number"},
                         {"first_frame", "integer"}, {"frames", "integer"}, {"bytes", "integer"}};

bool has_type(const json& value, const std::string& type) {
  if (type == "integer") return value.is_number_unsigned() || value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") return value.is_array();
  if (type == "null") return value.is_null();
  if (type != "counts" || !value.is_object()) return false;
  for (const auto& [name, count] : value.items()) {
    if (name.empty() || !count.is_number_integer()) return false;
  }
  return true;
}

void expect_shape(const json& value, const json& shape, const std::string& where) {
  if (shape.is_string()) {
    EXPECT_TRUE(has_type(value, shape)) << where << " is " << value;
    return;
  }
  ASSERT_TRUE(value.is_object()) << where;
  std::set<std::string> found;
  std::set<std::string> promised;
  for (const auto& [name, field] : value.items()) found.insert(name);
  for (const auto& [name, field] : shape.items()) promised.insert(name);
  EXPECT_EQ(found, promised) << where;
  for (const auto& [name, field] : shape.items()) {
    if (value.contains(name)) expect_shape(value[name], field, where + "." + name);
  }
}

class JsonTest : public CommandTest {};

TEST_F(JsonTest, StatsAddUp) {
  make_library();
  const json stats = document({"stats", "lib.rpz"});
  expect_shape(stats, stats_shape, "stats");
  std::uint64_t parts = 0;
  for (const auto& [name, bytes] : stats["bytes"].items()) parts += bytes.get<std::uint64_t>();
  EXPECT_EQ(parts, stats["archive_bytes"]);
  EXPECT_EQ(stats["archive_bytes"], std::filesystem::file_size(folder() / "lib.rpz"));
  EXPECT_EQ(stats["takes"], 4);
  EXPECT_EQ(stats["fidelity"], json({{"standard", 4}}));
  EXPECT_NEAR(stats["ratio"]["raw"].get<double>(),
              stats["raw_bytes"].get<double>() / stats["archive_bytes"].get<double>(), 1e-9);
  std::uint64_t text = 0;
  for (const auto& [name, content] : files_below(folder() / "takes")) {
    if (name.ends_with(".bvh")) text += content.size();
  }
  EXPECT_EQ(stats["text_bytes"], text);
}

TEST_F(JsonTest, ListsHaveTheirFields) {
  make_library();
  const json takes = document({"list", "lib.rpz"});
  expect_shape(takes, {{"takes", "array"}}, "list");
  ASSERT_EQ(takes["takes"].size(), 4U);
  for (const json& take : takes["takes"]) expect_shape(take, take_shape, "take");
  const json clips = document({"list", "lib.rpz", "--clips"});
  expect_shape(clips, {{"clips", "array"}}, "list --clips");
  ASSERT_GE(clips["clips"].size(), 4U);
  for (const json& clip : clips["clips"]) {
    json shape = clip_shape;
    if (clip.at("kind") == "repeated") shape["primary"] = "string";
    expect_shape(clip, shape, "clip");
    EXPECT_LT(clip["start"].get<double>(), clip["end"].get<double>());
  }
  const json skeletons = document({"list", "lib.rpz", "--skeletons"});
  ASSERT_GE(skeletons.at("skeletons").size(), 1U);
  EXPECT_TRUE(skeletons["skeletons"][0].at("joints").is_number_integer());
}

TEST_F(JsonTest, IngestTellsWhatBecameOfEachInput) {
  output({"synth", "takes", "--takes", "2", "--seconds", "2"});
  write_file(folder() / "takes/broken.bvh", "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 nonsense\n");
  const json first = document({"ingest", "lib.rpz", "takes"}, 3);
  const json shape = {{"added", "array"},          {"skipped", "array"},
                      {"other_fidelity", "array"}, {"other_metadata", "array"},
                      {"other_reading", "array"},  {"takes_not_found", "array"},
                      {"rejected", "array"},       {"seconds", "number"},
                      {"stats", stats_shape},      {"replaced", "array"},
                      {"same_source", "array"},    {"notes", "array"},
                      {"other_kinds", "counts"},   {"estimate", "null"},
                      {"assumed_units", "array"},  {"implausible_units", "array"}};
  expect_shape(first, shape, "ingest");
  EXPECT_EQ(first["added"].size(), 2U);
  ASSERT_EQ(first["rejected"].size(), 1U);
  expect_shape(first["rejected"][0],
               {{"path", "string"}, {"line", "integer"}, {"why", "string"}, {"advice", "string"}},
               "rejected");
  EXPECT_EQ(first["rejected"][0]["line"], 4);
  const json second = document({"ingest", "lib.rpz", "takes"}, 3);
  EXPECT_EQ(second["skipped"].size(), 2U);
  EXPECT_EQ(second["added"].size(), 0U);
}

TEST_F(JsonTest, CompareAndVerify) {
  make_library();
  const std::string name = take_names().front();
  const std::string source = "takes/" + name + ".bvh";
  const json same = document({"compare", source, source});
  const json shape = {{"frames", "integer"},
                      {"missing_frames", "integer"},
                      {"mean_mm", "number"},
                      {"rms_mm", "number"},
                      {"p99_mm", "number"},
                      {"max_mm", "number"},
                      {"d_percent", "number"},
                      {"foot_skate_mm_s", {{"original", "number"}, {"decoded", "number"}}},
                      {"rotation_deg", turns_shape},
                      {"local_rotation_deg", turns_shape},
                      {"worst_place", worst_shape},
                      {"worst_turn", worst_shape}};
  expect_shape(same, shape, "compare");
  EXPECT_EQ(same["max_mm"], 0);
  const json verified = document({"verify", "lib.rpz"});
  expect_shape(verified,
               {{"ok", "boolean"},
                {"takes", "integer"},
                {"clips", "integer"},
                {"damaged", "array"},
                {"error_mm", error_shape},
                {"rotation_deg", turns_shape},
                {"worst_place", worst_error_shape},
                {"worst_turn", worst_error_shape}},
               "verify");
  EXPECT_EQ(verified["ok"], true);
  EXPECT_EQ(verified["takes"], 4);
}

TEST_F(JsonTest, NoFootNoSkate) {
  const std::string text =
      "HIERARCHY\nROOT Box\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition "
      "Zrotation Xrotation Yrotation\n  End Site\n  {\n    OFFSET 0 10 0\n  }\n}\nMOTION\n"
      "Frames: 2\nFrame Time: 0.01\n0 0 0 0 0 0\n1 0 0 0 0 0\n";
  write_file(folder() / "box.bvh", text);
  EXPECT_TRUE(document({"compare", "box.bvh", "box.bvh"}).at("foot_skate_mm_s").is_null());
}

TEST_F(JsonTest, ErrorsAreDocumentsToo) {
  const json missing = document({"list", "nowhere.rpz"}, 1);
  EXPECT_EQ(missing.at("error").at("code"), 1);
  EXPECT_TRUE(missing["error"].at("message").is_string());
  const json usage = document({"list", "nowhere.rpz", "--clisp"}, 2);
  EXPECT_EQ(usage.at("error").at("name"), "usage");
}

TEST_F(JsonTest, NamesThatAreNotUtf8StillGiveADocument) {
  output({"synth", "takes", "--takes", "1", "--seconds", "2"});
  for (const auto& [name, content] : files_below(folder() / "takes")) {
    if (name.ends_with(".bvh")) write_file(folder() / "odd" / "b\xE4r.bvh", content);
  }
  const json ingested = document({"ingest", "odd.rpz", "odd"});
  EXPECT_EQ(ingested.at("added").size(), 1U);
  EXPECT_EQ(document({"list", "odd.rpz"}).at("takes").size(), 1U);
}

TEST_F(JsonTest, IdsOfNamesThatAreNotUtf8AreGoodForOtherCommands) {
  make_library();
  const std::string text = read_file(folder() / "takes" / (take_names().front() + ".bvh"));
  for (const char* name : {"a/b\xE4r", "a/\xE4\xB8z\xC0\x80", "a/\xC3\xA4\xED\xA0\x80"}) {
    write_file(folder() / "odd" / (std::string(name) + ".bvh"), text);
  }
  output({"ingest", "odd.rpz", "odd", "--no-repeats"});
  const json listed = document({"list", "odd.rpz"});
  for (const json& take : listed.at("takes")) {
    const auto id = take.at("id").get<std::string>();
    EXPECT_EQ(document({"info", "odd.rpz", id}).at("take").at("id"), id);
    EXPECT_EQ(document({"info", "odd.rpz", id.substr(2)}).at("take").at("id"), id);
  }
  // Two names that look the same in a document: neither is meant.
  write_file(folder() / "odd" / "a" / "b\xF6r.bvh", text);
  output({"ingest", "odd.rpz", "odd", "--no-repeats"});
  EXPECT_EQ(reprise({"remove", "odd.rpz", "b\xEF\xBF\xBDr"}).exit_code, 7);
  output({"remove", "odd.rpz", "b\xF6r"});
  EXPECT_EQ(document({"remove", "odd.rpz", "b\xEF\xBF\xBDr"}).at("removed").size(), 1U);
}

}  // namespace
}  // namespace reprise::cli

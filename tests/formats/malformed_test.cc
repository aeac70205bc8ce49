// Every file of tests/data/malformed is rejected with the file, the line and a sentence that names
// the fault.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

struct Malformed {
  const char* file;
  const char* named;  ///< the file that the error is in: of an AMC it may be the skeleton
  std::size_t line;
  const char* word;  ///< part of the sentence
};

const Malformed malformed_files[] = {
    {"empty.bvh", "empty.bvh", 1, "empty"},
    {"not_bvh.bvh", "not_bvh.bvh", 1, "HIERARCHY"},
    {"two_roots.bvh", "two_roots.bvh", 16, "second ROOT"},
    {"no_motion.bvh", "no_motion.bvh", 15, "MOTION"},
    {"brace_left_open.bvh", "brace_left_open.bvh", 15, "brace"},
    {"brace_too_many.bvh", "brace_too_many.bvh", 16, "never opened"},
    {"no_brace.bvh", "no_brace.bvh", 3, "outside"},
    {"joint_before_brace.bvh", "joint_before_brace.bvh", 3, "before the brace"},
    {"joint_without_name.bvh", "joint_without_name.bvh", 6, "no name"},
    {"offset_of_two.bvh", "offset_of_two.bvh", 8, "three numbers"},
    {"offset_of_words.bvh", "offset_of_words.bvh", 8, "'ten'"},
    {"channel_count_wrong.bvh", "channel_count_wrong.bvh", 9, "fewer channels"},
    {"channel_count_huge.bvh", "channel_count_huge.bvh", 9, "count of 0 to 6"},
    {"channel_unknown.bvh", "channel_unknown.bvh", 9, "Wrotation"},
    {"channels_twice.bvh", "channels_twice.bvh", 10, "twice"},
    {"word_unknown.bvh", "word_unknown.bvh", 10, "COLOUR"},
    {"end_site_with_channels.bvh", "end_site_with_channels.bvh", 13, "end site"},
    {"end_site_with_child.bvh", "end_site_with_child.bvh", 13, "end site"},
    {"no_frames_line.bvh", "no_frames_line.bvh", 17, "Frames:"},
    {"frames_not_a_number.bvh", "frames_not_a_number.bvh", 17, "Frames:"},
    {"frames_negative.bvh", "frames_negative.bvh", 17, "Frames:"},
    {"frames_too_many.bvh", "frames_too_many.bvh", 20, "1000000000000"},
    {"no_frame_time.bvh", "no_frame_time.bvh", 18, "Frame Time"},
    {"frame_time_negative.bvh", "frame_time_negative.bvh", 18, "Frame Time"},
    {"frame_time_in_milliseconds.bvh", "frame_time_in_milliseconds.bvh", 18, "cannot be meant"},
    {"frame_time_absurd.bvh", "frame_time_absurd.bvh", 18, "cannot be meant"},
    {"row_too_short.bvh", "row_too_short.bvh", 20, "8 numbers"},
    {"row_too_long.bvh", "row_too_long.bvh", 20, "10 numbers"},
    {"row_with_word.bvh", "row_with_word.bvh", 20, "'x1'"},
    {"row_with_nan.bvh", "row_with_nan.bvh", 20, "'nan'"},
    {"row_with_inf.bvh", "row_with_inf.bvh", 20, "'-inf'"},
    {"row_with_overflow.bvh", "row_with_overflow.bvh", 20, "'1e999'"},
    {"row_with_hex.bvh", "row_with_hex.bvh", 20, "'0x10'"},
    {"row_with_comma.bvh", "row_with_comma.bvh", 20, "'1,5'"},
    {"row_beyond_magnitude.bvh", "row_beyond_magnitude.bvh", 20, "beyond 1000000000: '1e300'"},
    {"row_over_two_lines.bvh", "row_over_two_lines.bvh", 20, "5 numbers"},
    {"nul_byte.bvh", "nul_byte.bvh", 20, "NUL"},
    {"long_number.bvh", "long_number.bvh", 20, "longer than 64"},
    {"no_channels.bvh", "no_channels.bvh", 6, "channels"},
    {"binary.bvh", "binary.bvh", 1, "HIERARCHY"},
    {"amc_empty.amc", "amc_empty.amc", 1, "no frames"},
    {"amc_without_frames.amc", "amc_without_frames.amc", 2, "no frames"},
    {"amc_bone_unknown.amc", "amc_bone_unknown.amc", 7, "fibula"},
    {"amc_bone_twice.amc", "amc_bone_twice.amc", 7, "twice"},
    {"amc_bone_missing_later.amc", "amc_bone_missing_later.amc", 10, "tibia"},
    {"amc_bones_change.amc", "amc_bones_change.amc", 10, "not those of the first"},
    {"amc_values_missing.amc", "amc_values_missing.amc", 6, "1 values"},
    {"amc_values_too_many.amc", "amc_values_too_many.amc", 7, "2 values"},
    {"amc_value_not_a_number.amc", "amc_value_not_a_number.amc", 6, "'two'"},
    {"amc_frame_skipped.amc", "amc_frame_skipped.amc", 8, "frame 3"},
    {"amc_before_first_frame.amc", "amc_before_first_frame.amc", 4, "before the first frame"},
    {"amc_number_beyond_magnitude.amc", "amc_number_beyond_magnitude.amc", 6, "beyond 1000000000"},
    {"amc_frame_without_bones.amc", "amc_frame_without_bones.amc", 4, "0 of its skeleton's"},
    {"amc_frame_number_huge.amc", "amc_frame_number_huge.amc", 4, "frame numbers end"},
    {"asf_length_tiny.amc", "asf_length_tiny.asf", 5, "cannot be meant"},
    {"asf_empty.amc", "asf_empty.asf", 1, "order"},
    {"asf_without_sections.amc", "asf_without_sections.asf", 1, "section"},
    {"asf_bone_without_name.amc", "asf_bone_without_name.asf", 29, "no name"},
    {"asf_two_bones_of_a_name.amc", "asf_two_bones_of_a_name.asf", 30, "two bones"},
    {"asf_direction_of_two.amc", "asf_direction_of_two.asf", 16, "direction"},
    {"asf_length_negative_unit.amc", "asf_length_negative_unit.asf", 5, "greater than 0"},
    {"asf_axis_order_wrong.amc", "asf_axis_order_wrong.asf", 18, "XXZ"},
    {"asf_dof_unknown.amc", "asf_dof_unknown.asf", 19, "rw"},
    {"asf_dof_twice.amc", "asf_dof_twice.asf", 19, "twice"},
    {"asf_hierarchy_unknown_bone.amc", "asf_hierarchy_unknown_bone.asf", 34, "fibula"},
    {"asf_two_parents.amc", "asf_two_parents.asf", 35, "two parents"},
    {"asf_bone_left_out.amc", "asf_bone_left_out.asf", 34, "leaves out"},
    {"asf_angle_unit.amc", "asf_angle_unit.asf", 6, "grad"},
    {"asf_children_before_parent.amc", "asf_children_before_parent.asf", 33,
     "before it has a parent"},
};

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRejectedWithItsLine) {
  const fs::path folder = REPRISE_TEST_DATA "/malformed";
  try {
    read_motion_file(folder / GetParam().file);
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::rejected_input);
    EXPECT_EQ(error.place().file, (folder / GetParam().named).string());
    EXPECT_EQ(error.place().line, GetParam().line) << error.what();
    EXPECT_NE(error.reason().find(GetParam().word), std::string::npos) << error.what();
    EXPECT_EQ(error.reason().find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(All, MalformedFile, testing::ValuesIn(malformed_files),
                         [](const auto& file) {
                           std::string name = file.param.file;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

TEST(MalformedFiles, AllAreListed) {
  std::set<std::string> listed;
  for (const Malformed& file : malformed_files) listed.insert(file.file);
  for (const auto& entry : fs::directory_iterator(REPRISE_TEST_DATA "/malformed")) {
    if (is_motion_file(entry.path())) {
      EXPECT_TRUE(listed.contains(entry.path().filename().string())) << entry.path();
    }
  }
}

}  // namespace
}  // namespace reprise

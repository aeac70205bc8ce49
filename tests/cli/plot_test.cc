// plot: a picture that other programs can read, and the parts of a take that it shows.
#include <png.h>

#include "cli/command_runner.h"

namespace reprise::cli {
namespace {

using nlohmann::json;

class PlotCommandTest : public CommandTest {
 protected:
  void SetUp() override { make_library(); }

  /// Width and height, or nothing where it is no whole PNG.
  static std::pair<unsigned, unsigned> size_of(const std::string& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0) return {};
    image.format = PNG_FORMAT_RGB;
    std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return {};
    return {image.width, image.height};
  }

  /// Parts follow one another from the take's first second to its last.
  static void expect_cover(const json& parts, double seconds) {
    ASSERT_FALSE(parts.empty());
    double at = 0;
    for (const json& part : parts) {
      EXPECT_EQ(part["start"], at);
      EXPECT_LT(part["start"].get<double>(), part["end"].get<double>());
      at = part["end"];
    }
    EXPECT_NEAR(at, seconds, 1e-9);
  }
};

TEST_F(PlotCommandTest, DrawsATake) {
  const json takes = document({"list", "lib.rpz"});
  const json take = takes["takes"][0];
  const std::string name = take["name"];
  const json plot = document({"plot", "lib.rpz", "--self-distance", name, "-o", "plot.png"});
  const double seconds = take["seconds"];
  expect_cover(plot["behaviours"], seconds);
  expect_cover(plot["clips"], seconds);
  // Those that are stored.
  const json stored = document({"list", "lib.rpz", "--take", name, "--clips"})["clips"];
  ASSERT_EQ(plot["clips"].size(), stored.size());
  for (std::size_t c = 0; c < stored.size(); ++c) {
    for (const auto& [field, value] : plot["clips"][c].items())
      EXPECT_EQ(stored[c][field], value) << field;
  }
  const std::string file = read_file(folder() / "plot.png");
  const auto [width, height] = size_of(file);
  EXPECT_GE(width, seconds * plot["rate"].get<double>());
  EXPECT_GT(height, width);
  EXPECT_EQ(output({"plot", "lib.rpz", "--self-distance", name, "-o", "-"}), file);
}

TEST_F(PlotCommandTest, DrawsKeyPosesOfATakeAndOfAClip) {
  const json take = document({"list", "lib.rpz"})["takes"][0];
  const std::string name = take["name"];
  const json whole = document({"plot", "lib.rpz", "--summary", name, "-o", "poses.png"});
  EXPECT_EQ(whole["take"], name);
  expect_cover(whole["key_poses"], take["seconds"]);
  const json known = document({"info", "lib.rpz", name});
  EXPECT_EQ(whole["key_poses"], known["take"]["key_poses"]);
  const auto [width, height] = size_of(read_file(folder() / "poses.png"));
  EXPECT_GT(width, height);

  const json clip = document({"list", "lib.rpz", "--clips"})["clips"].back();
  const json part =
      document({"plot", "lib.rpz", "--summary", clip["id"], "-o", "part.png"})["key_poses"];
  EXPECT_NEAR(part.front()["start"].get<double>(), clip["start"].get<double>(), 0.1);
  EXPECT_NEAR(part.back()["end"].get<double>(), clip["end"].get<double>(), 0.1);
  EXPECT_GT(size_of(read_file(folder() / "part.png")).first, 0u);
}

TEST_F(PlotCommandTest, KeepsAFileThatIsThere) {
  write_file(folder() / "plot.png", "mine");
  const std::vector<std::string> words = {"plot",          "lib.rpz", "--self-distance",
                                          take_names()[0], "-o",      "plot.png"};
  EXPECT_EQ(reprise(words).exit_code, 1);
  EXPECT_EQ(read_file(folder() / "plot.png"), "mine");
  std::vector<std::string> again = words;
  again.push_back("--overwrite");
  EXPECT_EQ(reprise(again).exit_code, 0);
  EXPECT_NE(read_file(folder() / "plot.png"), "mine");
}

TEST_F(PlotCommandTest, RefusesWhatMakesNoSense) {
  EXPECT_EQ(reprise({"plot", "lib.rpz", "-o", "plot.png"}).exit_code, 2);
  EXPECT_EQ(reprise({"plot", "lib.rpz", "--self-distance", take_names()[0]}).exit_code, 2);
  EXPECT_EQ(reprise({"plot", "lib.rpz", "--summary", "no-such", "-o", "p.png"}).exit_code, 7);
  EXPECT_EQ(reprise({"plot", "lib.rpz", "--summary", take_names()[0], "--self-distance",
                     take_names()[0], "-o", "p.png"})
                .exit_code,
            2);
  EXPECT_EQ(reprise({"plot", "lib.rpz", "--self-distance", "no-such", "-o", "p.png"}).exit_code, 7);
}

}  // namespace
}  // namespace reprise::cli

// Source files byte for byte, whatever they look like, by the command alone.
#include <cmath>

#include "cli/command_runner.h"
#include "formats/samples.h"

namespace fs = std::filesystem;

namespace reprise::cli {
namespace {

/// Forty frames with numbers in a format of printf's.
std::string long_bvh(const char* number) {
  const std::string plain = plain_bvh();
  const std::string after = "Frame Time: 0.0083333\n";
  std::string text = plain.substr(0, plain.find("Frames:")) + "Frames: 40\n" + after;
  for (int frame = 0; frame < 40; ++frame) {
    for (int channel = 0; channel < 15; ++channel) {
      char word[64];
      const double value = 30 * std::sin(0.1 * frame + channel) + 1e-3 * (frame * 7 % 11);
      std::snprintf(word, sizeof word, number, value);
      text += word + std::string(channel == 14 ? "\n" : " ");
    }
  }
  return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::map<std::string, std::string> odd_motions() {
  const std::string bvh = long_bvh("%.6f");
  return {{"plain", bvh},
          {"general", long_bvh("%g")},
          {"exponents", long_bvh("%.4e")},
          {"integers", long_bvh("%.0f")},
          {"many digits", long_bvh("%.12f")},
          {"plus signs", long_bvh("%+.3f")},
          {"no zero before the point", replaced(bvh, " 0.", " .")},
          {"CRLF", with_line_ends(bvh, "\r\n")},
          {"CR", with_line_ends(bvh, "\r")},
          {"mixed line ends", replaced(bvh, "1\n", "1\r\n")},
          {"tabs", replaced(replaced(bvh, " ", "\t"), "Frame\tTime", "Frame Time")},
          {"two spaces", replaced(replaced(bvh, " ", "  "), "Frame  Time", "Frame Time")},
          {"trailing spaces", replaced(bvh, "\n", " \t \n")},
          {"empty lines", bvh + "\n\n \n"},
          {"no last line end", bvh.substr(0, bvh.size() - 1)},
          {"byte order mark", "\xEF\xBB\xBF" + bvh}};
}

class ExactTest : public CommandTest {
 protected:
  void write_sources() const {
    for (const auto& [name, text] : odd_motions()) {
      write_file(folder() / "takes" / (name + ".bvh"), text);
    }
    for (const Sample& sample : samples()) {
      const fs::path stem = folder() / "takes" / ("sample of " + sample.name);
      if (sample.skeleton.empty()) {
        write_file(stem.string() + ".bvh", sample.motion);
      } else {
        write_file(stem.string() + ".asf", sample.skeleton);
        write_file(stem.string() + ".amc", sample.motion);
      }
    }
    const fs::path commented = folder() / "takes" / "comments";
    write_file(commented.string() + ".asf", "# made by \xE9\xFE hand\n" + plain_asf());
    write_file(commented.string() + ".amc", "# made by \xE9\xFE hand\n\n" + plain_amc() + "# end");
  }
};

TEST_F(ExactTest, EveryFileComesBackByteForByte) {
  fs::create_directories(folder() / "takes");
  write_sources();
  const auto report =
      document({"ingest", "lib.rpz", "takes", "--fidelity", "exact", "--jobs", "2"});
  EXPECT_TRUE(report.at("rejected").empty()) << report.dump(2);
  output({"extract", "lib.rpz", "--all", "-d", "out"});
  const auto sources = files_below(folder() / "takes"), extracted = files_below(folder() / "out");
  EXPECT_EQ(sources.size(), extracted.size());
  for (const auto& [name, text] : sources) {
    const auto found = extracted.find(name);
    ASSERT_NE(found, extracted.end()) << name;
    EXPECT_TRUE(found->second == text) << name;
  }
  EXPECT_EQ(output({"extract", "lib.rpz", "tabs", "-o", "-"}), odd_motions().at("tabs"));
  output({"verify", "lib.rpz", "--against", "takes"});
}

}  // namespace
}  // namespace reprise::cli

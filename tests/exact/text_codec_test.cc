#include "exact/text_codec.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "reprise/error.h"

namespace reprise {
namespace {

std::string printed(const char* format, double value) {
  char text[64];
  const int length = std::snprintf(text, sizeof text, format, value);
  return {text, static_cast<std::size_t>(length)};
}

constexpr std::string_view hierarchy =
    "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition Zrotation "
    "Xrotation Yrotation\n  End Site\n  {\n    OFFSET 0 1 0\n  }\n}\n";

/// A BVH whose numbers are waves with noise, one that never changes, and one twice another.
std::string bvh_text(const char* number, const char* end, int frames, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.01);
  std::string text(hierarchy);
  text += std::string("MOTION") + end + "Frames: " + std::to_string(frames) + end +
          "Frame Time: 0.0333333" + end;
  for (int f = 0; f < frames; ++f) {
    for (int c = 0; c < 6; ++c) {
      const double wave = 90 * std::sin(f * 0.05 + (c == 5 ? 4 : c)) + noise(random);
      text += printed(number, c == 2 ? 15.7357 : c == 5 ? 2 * wave : wave);
      text += c < 5 ? " " : end;
    }
  }
  return text;
}

std::string amc_text(int frames, const char* end = "\r\n") {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0, 0.01);
  std::string text = std::string("#!OML:ASF H:\\some where.ASF") + end + ":FULLY-SPECIFIED" + end +
                     ":DEGREES" + end;
  for (int f = 1; f <= frames; ++f) {
    text += std::to_string(f) + end + "root";
    for (int c = 0; c < 6; ++c) {
      text += " " + printed("%g", 20 * std::sin(f * 0.03 + c) + noise(random));
    }
    const double tiny = noise(random) * 1e-14;
    for (const char* bone : {"lclavicle", "rclavicle"}) {
      std::string number = printed("%g", tiny);
      const std::size_t exponent = number.find("e-");
      if (exponent != std::string::npos && number.size() == exponent + 4)
        number.replace(exponent, 2, "e-0");
      text += std::string(end) + bone + " " + number;
    }
    text += end;
  }
  return text;
}

std::string_view known_of(std::string_view text) {
  const std::size_t motion = text.find("MOTION");
  return motion == std::string_view::npos ? std::string_view() : text.substr(0, motion);
}

std::size_t zstd_size(std::string_view text) {
  std::string frame(ZSTD_compressBound(text.size()), 0);
  return ZSTD_compress(frame.data(), frame.size(), text.data(), text.size(), 19);
}

std::vector<std::uint8_t> expect_round_trip(std::string_view text, std::string_view known) {
  const auto coded = encode_text(text, known);
  EXPECT_EQ(decode_text(coded, known, text.size()), text);
  if (!text.empty()) EXPECT_THROW(decode_text(coded, known, text.size() - 1), Error);
  EXPECT_LE(coded.size(), zstd_size(text));
  return coded;
}

TEST(TextCodec, NumbersAreMuchSmallerThanTheirText) {
  for (const char* number : {"%.6f", "%g", "%.4f", "%.9g", "%.3e"}) {
    for (const char* end : {"\n", "\r\n", "\r", " \n", "\t\r\n"}) {
      const std::string text = bvh_text(number, end, 300);
      const auto coded = expect_round_trip(text, known_of(text));
      if (number != std::string_view("%.3e") && number != std::string_view("%.9g")) {
        EXPECT_LT(coded.size() * 2, zstd_size(text)) << number;
      }
    }
  }
  const std::string amc = amc_text(300);
  EXPECT_LT(expect_round_trip(amc, "").size() * 2, zstd_size(amc));
}

TEST(TextCodec, OddTextsComeBack) {
  const std::string bvh = bvh_text("%.6f", "\n", 50), amc = amc_text(20);
  const std::string_view known = known_of(bvh);
  std::mt19937 random(3);
  std::string unusual = bvh;
  for (const char* word : {"1e-3", ".5", "+1", "-0", "1.", "-0.000000", "1e-015", "0x1", "nan"}) {
    const std::size_t line = unusual.rfind('\n', unusual.size() - 1 - random() % 3000);
    unusual.replace(line + 1, unusual.find(' ', line + 1) - line - 1, word);
  }
  const std::vector<std::string> texts = {"",
                                          "\n",
                                          " ",
                                          "1",
                                          "1\n",
                                          "MOTION",
                                          "Frame Time: 1\n",
                                          "Frame Time: 1\n1 2 3",
                                          "Frame Time: 1\n\n\n\n",
                                          "\xff\xfe\0\1\2",
                                          std::string("a\0b", 3),
                                          unusual,
                                          bvh.substr(0, bvh.size() - 1),
                                          bvh.substr(0, bvh.size() - 2),
                                          bvh + "\n\n",
                                          bvh + "# end",
                                          bvh.substr(0, bvh.size() / 2),
                                          amc.substr(0, amc.size() - 2),
                                          amc + "\r\n",
                                          "# c\n" + amc,
                                          amc + "21\r\n",
                                          amc + amc,
                                          bvh + bvh,
                                          std::string(100'000, '7'),
                                          std::string(10'000, '\n'),
                                          std::string(5'000, ' ') + "1 2 3",
                                          "Frame Time: 1\n1 \1 2\n1 \1 3\n"};
  for (const std::string& text : texts) {
    expect_round_trip(text, "");
    expect_round_trip(text, known);
    expect_round_trip(text, text);
  }
}

/// An AMC whose numbers are made of integers alone, so that no library's rounding is in it.
std::string integer_text() {
  std::string text = ":DEGREES\n";
  std::uint32_t random = 1;
  const auto noise = [&] {
    return static_cast<int>((random = random * 1664525 + 1013904223) >> 26);
  };
  std::array<int, 3> place = {120'000, -4'000, 31}, speed = {0, 900, -7};
  for (int frame = 1; frame <= 24; ++frame) {
    text += std::to_string(frame) + "\nroot";
    for (std::size_t c = 0; c < 3; ++c) {
      place[c] += speed[c] += noise() - 32 - place[c] / 512;
      const int whole = place[c] / 1000, rest = std::abs(place[c] % 1000);
      text += (place[c] < 0 && whole == 0 ? " -" : " ") + std::to_string(whole);
      if (rest != 0) {
        std::string decimals = std::to_string(1000 + rest).substr(1);
        while (decimals.back() == '0') decimals.pop_back();
        text += "." + decimals;
      }
    }
    text +=
        "\nclavicle " + std::string(frame % 3 == 0 ? "3.97569e-016" : "-1.59028e-015") + " 15.5\n";
  }
  return text;
}

std::string hexadecimal_of(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

std::vector<std::uint8_t> bytes_of_hexadecimal(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoi(std::string(text.substr(i, 2)), nullptr, 16)));
  }
  return bytes;
}

// Builds of all compilers and optimisation levels have to write and read the same bits. What
// changes these bytes changes the format.
TEST(TextCodec, EveryBuildWritesAndReadsTheSameBytes) {
  constexpr std::string_view known_bytes =
      "052f00005101003a444547524545530a00010a726f6f742001200120010a636c617669636c652001"
      "20010a00372e3335001800048520e903ecf4c1ff30713f7c5e28c8d21fc1c3f74635aa6462a83397"
      "0f1840f337ef41331af13550787742992d3eaabaf10d990a739ccc860ecadd0f793beb2d1a8a9fd7"
      "9a01031a34075912aad6764f5498b66e7b7d5edf5a9612600ff22f816746b88f6a639a7b7358b7a8"
      "f22825af517faf11ee676a86cb5d1e1471731c69e6846fd4a818b7b10ade7c6adde52e2f75beb2f8"
      "8d48f99544d64eb1f1e54a";
  const std::string text = integer_text();
  const auto known = bytes_of_hexadecimal(known_bytes);
  EXPECT_EQ(decode_text(known, ""), text);
  // The strings are a frame that another version of zstd may write in another way.
  const auto coded = encode_text(text, "");
  ASSERT_GT(coded.size(), 2u);
  ASSERT_LT(coded[1], 128);
  const std::size_t bits = 2u + coded[1], known_bits = 2u + known[1];
  EXPECT_EQ(hexadecimal_of(std::span(coded).subspan(bits)),
            hexadecimal_of(std::span(known).subspan(known_bits)));
}

TEST(TextCodec, MutatedTextsComeBack) {
  std::mt19937 random(4);
  const std::string alphabet = "0123456789.-+eE \t\r\n#aF:\1\xff";
  const std::vector<std::string> sources = {bvh_text("%.6f", "\n", 12), bvh_text("%g", "\r\n", 12),
                                            amc_text(6)};
  for (int round = 0; round < 600; ++round) {
    std::string text = sources[random() % sources.size()];
    const std::string known(known_of(text));
    for (auto change = random() % 8 + 1; change > 0 && !text.empty(); --change) {
      const std::size_t place = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[place] = alphabet[random() % alphabet.size()];
          break;
        case 1:
          text.insert(place, 1, alphabet[random() % alphabet.size()]);
          break;
        case 2:
          text.erase(place, random() % 20 + 1);
          break;
        default:
          text.insert(place, text.substr(random() % text.size(), random() % 50));
      }
    }
    expect_round_trip(text, known);
  }
}

/// Either an error of a damaged archive, or some text; never anything else.
void expect_no_harm(std::span<const std::uint8_t> coded, std::string_view known) {
  try {
    decode_text(coded, known);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::damaged);
  }
}

TEST(TextCodec, DamagedBytesDoNoHarm) {
  std::mt19937 random(5);
  const std::string bvh = bvh_text("%.6f", "\n", 20), amc = amc_text(20),
                    plain = "no frames at all";
  for (const std::string* text : {&bvh, &amc, &plain}) {
    const std::string_view known = known_of(*text);
    const auto coded = encode_text(*text, known);
    EXPECT_THROW(decode_text({}, known), Error);
    for (std::size_t size = 1; size < coded.size(); ++size) {
      expect_no_harm(std::span(coded).first(size), known);
    }
    for (int round = 0; round < 1000; ++round) {
      auto damaged = coded;
      for (auto change = random() % 3 + 1; change > 0; --change) {
        damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
      }
      expect_no_harm(damaged, known);
    }
  }
  for (int round = 0; round < 1000; ++round) {
    std::vector<std::uint8_t> noise(random() % 200 + 1);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    noise[0] = static_cast<std::uint8_t>(random() % 8);
    expect_no_harm(noise, "known");
  }
}

TEST(TextCodec, TakesOfRealSetsComeBack) {
  const char* data = std::getenv("REPRISE_DATA");
  if (data == nullptr) GTEST_SKIP() << "REPRISE_DATA is not set";
  for (const char* set : {"cmu-asfamc/02", "bandai-namco", "cmu-iclone-bvh"}) {
    int count = 0;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(data) / set))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      if (file.extension() == ".asf" || file.extension() == ".ASF" || ++count > 3) continue;
      std::ifstream stream(file, std::ios::binary);
      std::stringstream content;
      content << stream.rdbuf();
      const std::string text = content.str();
      EXPECT_LT(expect_round_trip(text, known_of(text)).size() * 5, text.size()) << file;
    }
  }
}

}  // namespace
}  // namespace reprise

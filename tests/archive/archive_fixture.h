// What tests of whole archives share: a folder of their own, and joint places by a way that shares
// nothing with the library.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "reprise/archive.h"
#include "reprise/synth/library.h"

namespace reprise {

namespace fs = std::filesystem;

/// Places of all joints, in mm, by a way of its own: nothing here is shared with the library.
inline std::vector<double> places(const Skeleton& skeleton, const ChannelMatrix& channels,
                                  long frame) {
  using M = std::array<double, 9>;
  const auto times = [](const M& a, const M& b) {
    M c{};
    for (int i = 0; i < 9; ++i) {
      for (int k = 0; k < 3; ++k) c[i] += a[i / 3 * 3 + k] * b[k * 3 + i % 3];
    }
    return c;
  };
  const auto about = [](int axis, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180),
                 s = std::sin(degrees * std::numbers::pi / 180);
    if (axis == 0) return M{1, 0, 0, 0, c, -s, 0, s, c};
    if (axis == 1) return M{c, 0, s, 0, 1, 0, -s, 0, c};
    return M{c, -s, 0, s, c, 0, 0, 0, 1};
  };
  std::vector<M> turned;
  std::vector<std::array<double, 3>> at;
  std::vector<double> result;
  for (const Joint& joint : skeleton.joints) {
    const M parent = joint.parent < 0 ? M{1, 0, 0, 0, 1, 0, 0, 0, 1} : turned[joint.parent];
    std::array<double, 3> place = joint.parent < 0 ? std::array<double, 3>{} : at[joint.parent];
    std::array<double, 3> t = {joint.offset[0], joint.offset[1], joint.offset[2]};
    M rotation = parent;
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const double value = channels(frame, joint.first_channel + static_cast<Eigen::Index>(c));
      const int kind = static_cast<int>(joint.channels[c]);
      if (kind < 3) {
        t[kind] = value;
      } else {
        rotation = times(rotation, about(kind - 3, value));
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k)
        place[i] += parent[i * 3 + k] * t[k] * skeleton.millimetres_per_unit;
      result.push_back(place[i]);
    }
    turned.push_back(rotation);
    at.push_back(place);
  }
  return result;
}

/// Distance of every joint and end site in every frame, mm.
inline std::vector<double> distances(const Take& a, const Take& b) {
  std::vector<double> result;
  for (long f = 0; f < a.frames(); ++f) {
    const auto p = places(*a.skeleton, a.channels, f), q = places(*b.skeleton, b.channels, f);
    for (std::size_t j = 0; j + 2 < p.size(); j += 3) {
      result.push_back(std::hypot(p[j] - q[j], p[j + 1] - q[j + 1], p[j + 2] - q[j + 2]));
    }
  }
  return result;
}

inline double mean_distance(const Take& a, const Take& b) {
  const std::vector<double> all = distances(a, b);
  double sum = 0;
  for (const double distance : all) sum += distance;
  return sum / static_cast<double>(all.size());
}

inline double greatest_distance(const Take& a, const Take& b) {
  return std::ranges::max(distances(a, b));
}

class ArchiveTest : public testing::Test {
 protected:
  ArchiveTest() {
    std::string pattern = (fs::temp_directory_path() / "reprise-test-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~ArchiveTest() override { fs::remove_all(folder_); }

  void synthesise(const std::string& name, std::size_t takes, std::uint64_t seed,
                  double seconds = 4) {
    SynthOptions options;
    options.takes = takes;
    options.seconds = seconds;
    options.subjects = 2;
    options.seed = seed;
    write_synthetic_library(folder_ / name, options, true);
  }
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  IngestReport add(const std::string& archive, const std::vector<std::string>& names,
                   double mean_mm = 20, unsigned jobs = 2) {
    IngestOptions options;
    for (const std::string& name : names) options.paths.push_back(folder_ / name);
    options.fidelity = {FidelityTier::preview, mean_mm};
    options.jobs = jobs;
    return ingest(folder_ / archive, options);
  }
  void expect_all_within(const std::string& archive, const std::string& sources, double mean_mm) {
    const Archive stored(folder_ / archive);
    for (const TakeInfo& info : stored.takes()) {
      fs::path path = folder_ / sources / info.name;
      const Take source = read_motion_file(path += ".bvh");
      const Take decoded = stored.extract(info);
      ASSERT_EQ(decoded.frames(), source.frames());
      ASSERT_EQ(decoded.layout.frame_time_text, source.layout.frame_time_text);
      ASSERT_EQ(decoded.skeleton->source_text, source.skeleton->source_text);
      const double mean = mean_distance(source, decoded);
      EXPECT_LE(mean, mean_mm) << info.name;
      EXPECT_NEAR(mean, info.error_mm.mean, 0.01) << info.name;
    }
  }
  std::string digest(const std::string& archive) {
    return Archive(folder_ / archive).info().content_digest;
  }

  fs::path folder_;
};

}  // namespace reprise

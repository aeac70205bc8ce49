// Units, up axes and bodies of files that people keep in public, where they are at hand.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "reprise/error.h"
#include "reprise/query/body_joints.h"
#include "reprise/query/take_reading.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// REPRISE_DATA/`name`, or none.
std::optional<fs::path> data(const char* name) {
  const char* folder = std::getenv("REPRISE_DATA");
  if (folder == nullptr || !fs::exists(fs::path(folder) / name)) return std::nullopt;
  return fs::path(folder) / name;
}

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const fs::path& table) {
  std::ifstream file(table);
  std::string line;
  const auto cells = [&] {
    std::vector<std::string> found;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '\t');) found.push_back(cell);
    return found;
  };
  std::getline(file, line);
  const std::vector<std::string> header = cells();
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    Row row;
    const std::vector<std::string> values = cells();
    for (std::size_t i = 0; i < std::min(header.size(), values.size()); ++i) {
      row[header[i]] = values[i];
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::optional<TakeReading> reading_of(const fs::path& file) {
  try {
    const Take take = read_motion_file(file);
    const ReadingEvidence evidence = reading_evidence(take);
    return find_reading(*take.skeleton, {&evidence, 1}, {});
  } catch (const Error&) {
    return std::nullopt;
  }
}

TEST(PublicFiles, HaveTheUnitsAndUpAxesThatTheirBodiesSay) {
  const auto corpus = data("corpus");
  if (!corpus) GTEST_SKIP() << "REPRISE_DATA has no corpus";
  int sure = 0, right = 0, up_axes = 0;
  for (Row& row : rows_of(*corpus / "truth.tsv")) {
    if (!row["file"].ends_with(".bvh")) continue;
    const auto reading = reading_of(*corpus / row["file"]);
    if (!reading) continue;
    if (const auto up = find_up_axis(row["up"])) {
      ++up_axes;
      EXPECT_EQ(up_axis_name(reading->up), up_axis_name(*up)) << row["file"];
    }
    if (row["sure"] != "yes" || row["unit_mm"] == "unclear") continue;
    ++sure;
    const double unit = std::stod(row["unit_mm"]);
    right += std::abs(reading->millimetres_per_unit / unit - 1) < 0.01 ? 1 : 0;
  }
  EXPECT_GT(sure, 50);
  EXPECT_GT(up_axes, 90);
  EXPECT_GE(right, 0.95 * sure) << right << " of " << sure;
  std::cout << "units: " << right << " of " << sure << ", up axes: " << up_axes << "\n";
}

TEST(PublicFiles, HaveAWholeBodyUnderEveryMakersNames) {
  const auto names = data("field/names");
  if (!names) GTEST_SKIP() << "REPRISE_DATA has no field/names";
  int files = 0;
  for (const auto& entry : fs::directory_iterator(*names)) {
    const Take take = read_motion_file(entry.path());
    const BodyMatch match = match_body(*take.skeleton);
    EXPECT_TRUE(match.is_body()) << entry.path();
    for (const int joint : match.joints) EXPECT_GE(joint, 0) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace reprise

// A motion file through a whole archive: what is taken in keeps its promise when it comes out.
#include "fuzz/fuzz_input.h"
#include "fuzz/scratch_folder.h"
#include "reprise/archive.h"
#include "reprise/error.h"

using namespace reprise;

namespace {

constexpr FidelityTier tiers[] = {FidelityTier::preview, FidelityTier::standard, FidelityTier::fine,
                                  FidelityTier::exact};

void check_stored(const std::filesystem::path& path, const std::filesystem::path& source,
                  FidelityTier tier) {
  const Archive archive(path);
  const std::vector<TakeInfo> takes = archive.takes();
  expect(takes.size() == 1, "a take that was added is there");
  const Take decoded = archive.extract(takes[0]);
  const Comparison comparison = compare_takes(read_motion_file(source), decoded);
  const double slack = 1e-9;
  expect(comparison.missing_frames == 0, "no frame is lost");
  if (tier == FidelityTier::preview) {
    expect(comparison.errors.mean <= FidelityLimits::preview_mean_mm + slack, "the mean is kept");
  } else if (tier == FidelityTier::exact) {
    expect(archive.source_text(takes[0]) == read_scratch(source), "a text comes back");
  } else {
    expect(comparison.errors.max <= fidelity_of(tier).limit_mm + slack, "the bound is kept");
    expect(comparison.turns.max <= fidelity_of(tier).limit_deg + slack, "no joint turns too far");
  }
  const VerifyReport report = archive.verify(source.parent_path());
  expect(report.ok, report.damaged.empty() ? "" : report.damaged[0].why);
}

}  // namespace

/// Input: the tier; then a BVH, or an ASF, a zero byte and an AMC.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path folder = scratch_folder() / "takes";
  static const std::filesystem::path path = scratch_folder() / "ingested.rpz";
  std::filesystem::remove_all(folder);
  std::filesystem::remove(path);
  std::filesystem::create_directories(folder);
  FuzzInput input(data, size);
  const FidelityTier tier = tiers[input.choice(std::size(tiers))];
  const std::string_view text = input.text();
  const std::size_t end = text.find('\0');
  std::filesystem::path source = folder / "t.bvh";
  if (end == std::string_view::npos) {
    write_scratch(source, text);
  } else {
    write_scratch(folder / "t.asf", text.substr(0, end));
    write_scratch(source = folder / "t.amc", text.substr(end + 1));
  }
  IngestOptions options;
  options.paths = {folder};
  options.fidelity = fidelity_of(tier);
  const IngestReport report = ingest(path, options);
  expect(report.added.size() + report.rejected.size() >= 1, "an input is added or rejected");
  if (!report.added.empty()) check_stored(path, source, tier);
  return 0;
}

// Reads and decodes everything, and holds it against its sources where they are at hand.
#include <cmath>
#include <map>

#include "query/archive_impl.h"
#include "reprise/error.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// The promise of a take, as a limit on what comparing it with its source may show.
bool is_within(const Fidelity& fidelity, const PositionErrors& errors) {
  switch (fidelity.tier) {
    case FidelityTier::preview:
      return errors.mean <= fidelity.limit_mm;
    default:
      return errors.max <= fidelity.limit_mm;
  }
}

std::string broken_promise(const Fidelity& fidelity, const PositionErrors& errors) {
  return "its mean error is " + std::to_string(errors.mean) + " mm, more than the " +
         std::to_string(fidelity.limit_mm) + " mm of its fidelity";
}

/// Motion files below a folder by the names that an ingest of it gives takes, and by trailing parts
/// of them.
std::map<std::string, fs::path> sources_under(const fs::path& folder) {
  std::map<std::string, fs::path> sources;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_motion_file(entry.path())) continue;
    fs::path relative = entry.path().lexically_relative(folder);
    sources.emplace(relative.generic_string(), entry.path());
    sources.emplace(relative.replace_extension().generic_string(), entry.path());
  }
  return sources;
}

const fs::path* source_of(const std::map<std::string, fs::path>& sources, const std::string& take) {
  // A prefix of the ingest stands before the name under the folder.
  for (std::size_t at = 0; at != std::string::npos;) {
    const auto found = sources.find(take.substr(at));
    if (found != sources.end()) return &found->second;
    const std::size_t slash = take.find('/', at);
    at = slash == std::string::npos ? slash : slash + 1;
  }
  return nullptr;
}

}  // namespace

VerifyReport Archive::verify(const std::optional<fs::path>& against, const ReadOptions& read,
                             const ProgressSink& progress) const {
  VerifyReport report;
  report.damaged = impl_->store.check_structure();
  std::map<std::string, fs::path> sources;
  if (against) sources = sources_under(*against);
  std::vector<TakeInfo> all;
  try {
    all = takes();
    report.clips = clips().size();
    report.error_mm = stats().error_mm;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::damaged) throw;
    if (report.damaged.empty()) report.damaged.push_back({"takes", error.reason()});
  }
  report.takes = all.size();
  std::vector<float> distances;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (progress && !progress({i, all.size(), all[i].name})) {
      throw Error(ErrorCode::interrupted, "stopped");
    }
    try {
      const Take decoded = extract(all[i]);
      if (!decoded.channels.allFinite()) {
        report.damaged.push_back({all[i].name, "it decodes to numbers that are not finite"});
      }
      if (!against) continue;
      const fs::path* source = source_of(sources, all[i].name);
      if (source == nullptr) {
        report.damaged.push_back({all[i].name, "its source is not in the folder", true});
        continue;
      }
      const Take original = read_motion_file(*source, read);
      const Comparison comparison = compare_takes(original, decoded);
      if (comparison.missing_frames != 0) {
        report.damaged.push_back({all[i].name, "its source has another number of frames", true});
      }
      if (!is_within(all[i].fidelity, comparison.errors)) {
        report.damaged.push_back(
            {all[i].name, broken_promise(all[i].fidelity, comparison.errors), true});
      }
      const auto own = joint_distances(joint_positions(*original.skeleton, original.channels),
                                       joint_positions(*decoded.skeleton, decoded.channels));
      distances.insert(distances.end(), own.begin(), own.end());
    } catch (const Error& error) {
      if (error.code() == ErrorCode::interrupted) throw;
      report.damaged.push_back({all[i].name, error.reason()});
    }
  }
  if (against) report.error_mm = summarise_distances(distances);
  report.ok = report.damaged.empty();
  return report;
}

}  // namespace reprise

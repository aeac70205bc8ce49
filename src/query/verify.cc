// Reads and decodes everything, and holds it against its sources where they are at hand.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "query/archive_impl.h"
#include "query/distance_tally.h"
#include "query/promise.h"
#include "query/source_folder.h"
#include "query/take_decoder.h"
#include "reprise/error.h"
#include "store/digest.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// Whether a take can be written to its name under a folder: relative, without empty components,
/// "." and "..". Nobody is given others.
bool leads_inside(std::string_view name) {
  if (name.empty() || name.find('\0') != std::string_view::npos) return false;
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('/', at), name.size());
    const std::string_view component = name.substr(at, end - at);
    if (component.empty() || component == "." || component == "..") return false;
    at = end + 1;
  }
  return true;
}

/// Decodes every layer of a take, and holds each against the source where there is one.
class TakeCheck {
 public:
  TakeCheck(OpenArchive& archive, TakeRecord record)
      : archive_(archive), record_(std::move(record)) {}

  std::vector<Damage> run(const fs::path* source, ReadOptions read) {
    std::optional<Take> original;
    const auto& proportions = archive_.proportions(record_.proportions);
    if (!read.bvh_millimetres_per_unit) {
      read.bvh_millimetres_per_unit = proportions.millimetres_per_unit;
    }
    // As it was taken in: what is missing now shows in the number of frames.
    if (!read.frame_rate) read.frame_rate = proportions.frame_rate;
    read.partial = true;
    try {
      if (source != nullptr) original = read_motion_file(*source, read);
    } catch (const Error& error) {
      // What is wrong with a source is no damage of the archive.
      note(std::string("its source cannot be read: ") + error.what(), true);
      source = nullptr;
    }
    if (!leads_inside(record_.info.name)) {
      note("its name leads out of the folder that it would be written to", false);
    }
    if (proportions.asf_name.find('/') != std::string::npos) {
      note("its skeleton's name leads to another folder", false);
    }
    for (std::size_t i = 0; i < record_.layers.size(); ++i) {
      std::string text;
      const Take decoded = decode_layer(archive_, record_, i, &text);
      if (original) compare(*original, decoded, record_.layers[i]);
      if (record_.layers[i].kind == LayerKind::text) check_text(decoded, text, source);
    }
    return std::move(damaged_);
  }

  /// Of the finest layer, once a source was compared with; in no order.
  const MotionDistances& distances() const { return distances_; }

 private:
  void note(std::string why, bool outside_fidelity) {
    damaged_.push_back({record_.info.name, std::move(why), outside_fidelity});
  }

  void compare(const Take& original, const Take& decoded, const LayerRecord& layer) {
    if (original.frames() != decoded.frames()) {
      if (damaged_.empty()) note("its source has another number of frames", true);
      return;
    }
    if (!same_structure(*original.skeleton, *decoded.skeleton)) {
      if (damaged_.empty()) note("its source has another skeleton", true);
      return;
    }
    distances_ = motion_distances(*original.skeleton, original.channels, decoded.channels, false,
                                  decoded.skeleton.get());
    const MotionErrors errors = summarise_motion(distances_, original.skeleton->joints.size());
    const std::string broken = broken_promise(layer, original, decoded, errors);
    if (!broken.empty()) note(broken, true);
  }

  /// The digest that was taken of the source tells whether its bytes come back.
  void check_text(const Take& decoded, const std::string& text, const fs::path* source) {
    Hasher hasher;
    hasher.add(text);
    if (decoded.skeleton->format == MotionFormat::asf_amc) {
      hasher.add(decoded.skeleton->source_text);
    }
    if (hexadecimal(hasher.finish()) != record_.info.source_digest) {
      note("its text is not that of its source", false);
    } else if (source != nullptr && text != read_whole_file(*source)) {
      note("its source is not what was taken in", true);
    }
  }

  OpenArchive& archive_;
  TakeRecord record_;
  std::vector<Damage> damaged_;
  MotionDistances distances_;
};

}  // namespace

VerifyReport Archive::verify(const std::optional<fs::path>& against, const ReadOptions& read,
                             const ProgressSink& progress) const {
  VerifyReport report;
  const auto go_on = [&](const Progress& now) {
    if (progress && !progress(now)) throw Error(ErrorCode::interrupted, "stopped");
  };
  std::optional<SourceFolder> sources;
  if (against) sources.emplace(*against, [&] { go_on({}); });
  std::vector<TakeInfo> all;
  std::optional<ArchiveStore::Snapshot> snapshot = impl_->snapshot();
  const std::int64_t state = impl_->store.state_number();
  report.damaged = impl_->store.check_structure();
  try {
    all = takes();
    report.clips = clips().size();
    const ArchiveStats recorded = stats();
    report.error_mm = recorded.error_mm;
    report.rotation_deg = recorded.rotation_deg;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::damaged) throw;
    if (report.damaged.empty()) report.damaged.push_back({"takes", error.reason()});
  }
  snapshot.reset();
  report.takes = all.size();
  if (!against) report.measured = all.size();
  DistanceTally places, turns;
  for (std::size_t i = 0; i < all.size(); ++i) {
    go_on({i, all.size(), all[i].name});
    try {
      // A writer waits for one take at most. What it takes out meanwhile is no damage.
      const ArchiveStore::Snapshot snapshot_of_take = impl_->snapshot();
      const bool changed = impl_->store.state_number() != state;
      std::optional<TakeRecord> record =
          changed ? impl_->store.find_take(all[i].name) : impl_->store.take(all[i].id);
      if (!record) continue;
      const fs::path* source = sources ? sources->source_of(all[i]) : nullptr;
      TakeCheck check(*impl_, std::move(*record));
      for (Damage& damage : check.run(source, read)) report.damaged.push_back(std::move(damage));
      if (against && source == nullptr) {
        report.damaged.push_back({all[i].name, "its source is not in the folder", true});
      }
      places.add(check.distances().places);
      turns.add(check.distances().turns);
      if (!check.distances().places.empty()) ++report.measured;
    } catch (const Error& error) {
      const ErrorCode code = error.code();
      // What is wrong with the machine, or with who asks, is no damage.
      if (code != ErrorCode::damaged && code != ErrorCode::failed) throw;
      report.damaged.push_back({all[i].name, error.reason()});
    }
  }
  if (sources) {
    std::ranges::copy(sources->unread(), std::back_inserter(report.damaged));
    const PositionErrors turned = turns.errors();
    report.error_mm = places.errors();
    report.rotation_deg = {turned.mean, turned.p99, turned.max};
  }
  report.ok = report.damaged.empty();
  return report;
}

}  // namespace reprise

#include "synth/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace reprise::synth {
namespace {

/// How repeats differ from the motion itself: in speed as far as repeated-motion analysis is to
/// follow (0.5 to 2 times), and by smooth noise (RMS degrees a joint). (docs/measures.md).
constexpr std::array<double, 5> speeds = {0.5, 0.75, 1.0, 1.33, 2.0};
constexpr std::array<double, 3> noises = {0, 1, 3};
constexpr double longest_motif_seconds = 4;
constexpr double shortest_occurrence = 0.7;
/// A motif's share of a take's mean length, and the share of a take that motifs and their
/// surroundings may fill.
constexpr double motif_share = 0.35, filled_share = 0.8;
/// What an occurrence needs besides itself: transitions and something in between, in seconds.
constexpr double surroundings = 1.6;
constexpr std::size_t most_tries = 24;

std::size_t digits(std::size_t value) { return std::to_string(value).size(); }

class Planner {
 public:
  Planner(const SynthOptions& options, LibraryPlan& plan, Random random)
      : options_(options), plan_(plan), random_(random) {
    for (const PlannedTake& take : plan.takes) room_.push_back(filled_share * take.seconds);
  }

  void plan_motifs() {
    const double most = longest_motif(options_);
    if (most <= 0) return;
    // Failures in a row say that the takes are full.
    for (int failures = 0; failures < 20;) failures = plan_motif(most) ? 0 : failures + 1;
  }

 private:
  /// False where fewer than two takes have room for it; then nothing is planned.
  bool plan_motif(double most) {
    Motif motif;
    motif.behaviour =
        static_cast<Behaviour>(random_.below(static_cast<std::size_t>(Behaviour::count)));
    motif.seed = random_.next();
    motif.seconds = perform_motif(motif, most).seconds();
    std::vector<double> order(speeds.begin(), speeds.end());
    random_.shuffle(order);
    order.resize(2 + random_.below(speeds.size() - 1));
    order.insert(order.begin(), 1.0);
    std::vector<std::size_t> used;
    const std::size_t noise_before = next_noise_;
    for (double speed : order) {
      if (motif.seconds / speed < shortest_occurrence) speed = 1;
      const std::size_t take = find_room(motif.seconds / speed + surroundings, used);
      if (take == plan_.takes.size()) {
        if (used.empty()) return false;
        continue;
      }
      const double noise = used.empty() ? 0 : noises[next_noise_++ % noises.size()];
      plan_.takes[take].occurrences.push_back({plan_.motifs.size(), used.size(), speed, noise});
      room_[take] -= motif.seconds / speed + surroundings;
      used.push_back(take);
    }
    if (used.size() < 2) {
      plan_.takes[used.front()].occurrences.pop_back();
      room_[used.front()] += motif.seconds + surroundings;
      next_noise_ = noise_before;
      return false;
    }
    plan_.motifs.push_back(motif);
    plan_.occurrence_counts.push_back(used.size());
    return true;
  }

  /// A take with that much room that does not have the motif yet; a library of one take repeats
  /// itself in it.
  std::size_t find_room(double seconds, const std::vector<std::size_t>& used) {
    for (std::size_t attempt = 0; attempt < most_tries; ++attempt) {
      const std::size_t take = random_.below(plan_.takes.size());
      const bool again = std::find(used.begin(), used.end(), take) != used.end();
      if (room_[take] >= seconds && (!again || plan_.takes.size() == 1)) return take;
    }
    return plan_.takes.size();
  }

  const SynthOptions& options_;
  LibraryPlan& plan_;
  Random random_;
  std::vector<double> room_;
  std::size_t next_noise_ = 0;
};

}  // namespace

double longest_motif(const SynthOptions& options) {
  const double most = std::min(longest_motif_seconds, motif_share * options.seconds);
  return most < 1.2 ? 0 : most;
}

Performance perform_motif(const Motif& motif, double most_seconds) {
  Random random(motif.seed);
  return perform(motif.behaviour, random, most_seconds);
}

LibraryPlan plan_library(const SynthOptions& options) {
  LibraryPlan plan;
  Random random = Random(options.seed).fork(1);
  const std::size_t subjects = std::max<std::size_t>(1, std::min(options.subjects, options.takes));
  const std::size_t subject_digits = std::max<std::size_t>(2, digits(subjects));
  const std::size_t take_digits =
      std::max<std::size_t>(2, digits((options.takes + subjects - 1) / subjects));
  for (std::size_t i = 0; i < subjects; ++i)
    plan.subjects.push_back(fmt::format("s{:0{}}", i + 1, subject_digits));
  for (std::size_t i = 0; i < options.takes; ++i) {
    PlannedTake take;
    take.subject = i % subjects;
    const std::string& subject = plan.subjects[take.subject];
    take.name = fmt::format("{}/{}_{:0{}}", subject, subject, i / subjects + 1, take_digits);
    take.seconds = options.seconds * random.uniform(0.75, 1.25);
    plan.takes.push_back(take);
  }
  if (!plan.takes.empty()) Planner(options, plan, random.fork(2)).plan_motifs();
  for (PlannedTake& take : plan.takes) random.shuffle(take.occurrences);
  return plan;
}

}  // namespace reprise::synth

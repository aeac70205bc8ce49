#include "synth/take_maker.h"

#include <algorithm>
#include <cmath>

#include "synth/channels.h"
#include "synth/noise.h"
#include "synth/skeleton_text.h"
#include "synth/stage.h"

namespace reprise::synth {
namespace {

constexpr double amc_frame_rate = 120;
constexpr const char* bvh_frame_time = "0.0166667";
constexpr double bvh_frame_rate = 1 / 0.0166667;
constexpr const char* amc_header = "#!OML:ASF\n:FULLY-SPECIFIED\n:DEGREES\n";

/// Noise that a repeat is done with: seconds of its low-pass, and of its fade outside the repeat.
constexpr double repeat_noise_sigma = 0.15, repeat_noise_fade = 0.2;
/// The tremor that every capture has, in degrees: a slow part, and a fast one from frame to frame.
constexpr double tremor_low = 0.1, tremor_high = 0.3, tremor_sigma = 0.045;
constexpr double jitter = 0.03, jitter_sigma = 0.008;

constexpr std::uint64_t take_label = 1000, subject_label = 2000;

Random take_random(const SynthOptions& options, std::size_t index) {
  return Random(options.seed).fork(take_label).fork(index);
}

/// The same motion done by someone else at another time: a little more or less, a little
/// straighter.
void restyle(Performance& performance, Random& random) {
  const double size = random.uniform(0.93, 1.07);
  const TrackRow rest = standing();
  TrackMatrix& tracks = performance.tracks();
  for (int track = torso_pitch; track < track_count; ++track) {
    const double offset =
        track < arm_tracks ? random.uniform(-1.5, 1.5) : random.uniform(-2.5, 2.5);
    tracks.col(track) =
        (rest[track] + offset + size * (tracks.col(track).array() - rest[track])).matrix();
  }
}

/// Fills the take around its motifs.
class Filler {
 public:
  Filler(Stage& stage, const Subject& subject, Random random)
      : stage_(stage), subject_(subject), random_(random) {}

  /// Adds motion of about `seconds`, transitions included; at least some.
  void fill(double seconds) {
    const double until = stage_.seconds() + seconds;
    bool any = false;
    while (!any || until - stage_.seconds() > 0.8) {
      add_one(std::max(0.5, until - stage_.seconds() - 0.5));
      any = true;
    }
  }

 private:
  void add_one(double seconds) {
    const double choice = random_.uniform();
    if (seconds < 1.6 || choice < 0.2) {
      stage_.add(perform_idle(std::min(seconds, random_.uniform(0.8, 3)), random_), 1,
                 0.2 * stage_.choose_turn());
    } else if (choice < 0.6) {
      stage_.add(walk(std::min(seconds, random_.uniform(2, 6))), 1, stage_.choose_turn());
    } else {
      const auto behaviour =
          static_cast<Behaviour>(random_.below(static_cast<std::size_t>(Behaviour::count)));
      stage_.add(perform(behaviour, random_, std::min(seconds, 4.0)), 1, stage_.choose_turn());
    }
  }

  Performance walk(double seconds) {
    GaitStyle style = random_.chance(0.2) ? subject_.run : subject_.walk;
    style.step_length *= random_.uniform(0.92, 1.06);
    style.step_seconds *= random_.uniform(0.95, 1.05);
    const int steps = std::max(3, static_cast<int>((seconds - 0.5) / style.step_seconds));
    const double turn = random_.uniform(-25, 25) * std::min(steps, 7);
    return perform_steps(style, steps, turn, 0, random_.chance(0.5) ? Side::left : Side::right);
  }

  Stage& stage_;
  const Subject& subject_;
  Random random_;
};

/// Shares of the time between the motifs: one before, between and after them.
std::vector<double> gap_shares(std::size_t gaps, Random& random) {
  std::vector<double> shares(gaps);
  double sum = 0;
  for (double& share : shares) sum += share = random.uniform(0.5, 1.5);
  for (double& share : shares) share /= sum;
  return shares;
}

/// Puts the performances of a take on stage; returns the interval of each planned occurrence.
std::vector<FrameInterval> stage_take(const SynthOptions& options, const LibraryPlan& plan,
                                      const PlannedTake& planned, const Subject& subject,
                                      Stage& stage, Random random) {
  const double most = longest_motif(options);
  double free_seconds = planned.seconds;
  for (const PlannedOccurrence& occurrence : planned.occurrences) {
    free_seconds -= plan.motifs[occurrence.motif].seconds / occurrence.speed + 0.6;
  }
  const std::vector<double> shares = gap_shares(planned.occurrences.size() + 1, random);
  Filler filler(stage, subject, random.fork(1));
  std::vector<FrameInterval> intervals;
  for (std::size_t i = 0; i < planned.occurrences.size(); ++i) {
    filler.fill(shares[i] * free_seconds);
    const PlannedOccurrence& occurrence = planned.occurrences[i];
    Performance motif = perform_motif(plan.motifs[occurrence.motif], most);
    if (occurrence.place > 0) restyle(motif, random);
    intervals.push_back(stage.add(motif, occurrence.speed, stage.choose_turn()));
  }
  filler.fill(std::max(planned.seconds - stage.seconds(), 0.6));
  return intervals;
}

/// Noise of the repeats, and the tremor of the whole take.
void add_all_noise(PoseMatrix& poses, const PlannedTake& planned,
                   const std::vector<FrameInterval>& intervals, NoiseOptions options,
                   Random random) {
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (planned.occurrences[i].noise == 0) continue;
    NoiseOptions repeat = options;
    repeat.degrees = planned.occurrences[i].noise;
    repeat.sigma = repeat_noise_sigma;
    repeat.fade = std::lround(repeat_noise_fade * options.frame_rate);
    repeat.first = std::max(0L, intervals[i].first - repeat.fade);
    repeat.count = std::min(poses.rows(), intervals[i].last + repeat.fade) - repeat.first;
    add_noise(poses, repeat, random.fork(i + 2));
  }
  options.count = poses.rows();
  options.sigma = tremor_sigma;
  options.degrees = random.uniform(tremor_low, tremor_high);
  add_noise(poses, options, random.fork(0));
  options.sigma = jitter_sigma;
  options.degrees = jitter;
  add_noise(poses, options, random.fork(1));
}

void set_layout(Take& take) {
  if (take.skeleton->format == MotionFormat::bvh) {
    take.layout.frame_time_text = bvh_frame_time;
    return;
  }
  take.frame_rate_assumed = true;
  take.layout.amc_header = amc_header;
  for (std::size_t joint = 0; joint < take.skeleton->joints.size(); ++joint) {
    if (!take.skeleton->joints[joint].channels.empty())
      take.layout.amc_joints.push_back(static_cast<int>(joint));
  }
}

}  // namespace

Subject make_subject(const SynthOptions& options, const std::string& name, std::size_t index) {
  const Random random = Random(options.seed).fork(subject_label).fork(index);
  Subject subject;
  subject.body = random_proportions(random.fork(1));
  subject.posture = random_posture(random.fork(2));
  Random gait = random.fork(3);
  subject.walk = random_walk_style(gait);
  subject.run = random_run_style(gait);
  subject.skeleton = make_skeleton(options.format, subject.body, name);
  return subject;
}

MadeTake make_take(const SynthOptions& options, const LibraryPlan& plan, std::size_t index,
                   const Subject& subject) {
  const PlannedTake& planned = plan.takes[index];
  const Random random = take_random(options, index);
  const bool bvh = options.format == MotionFormat::bvh;
  MadeTake made;
  made.take.name = planned.name;
  made.take.skeleton = subject.skeleton;
  made.take.frame_rate = bvh ? bvh_frame_rate : amc_frame_rate;

  Stage stage(made.take.frame_rate, random.fork(1));
  const auto intervals = stage_take(options, plan, planned, subject, stage, random.fork(2));
  const TrackMatrix tracks = stage.tracks();
  const PoseMatrix clean = pose_body(tracks, made.take.frame_rate, subject.body, subject.posture);
  PoseMatrix poses = clean;
  NoiseOptions noise;
  noise.frame_rate = made.take.frame_rate;
  noise.free_only = !bvh;
  add_all_noise(poses, planned, intervals, noise, random.fork(3));
  limit_angles(poses);
  keep_feet(clean, tracks, subject.body, poses);
  made.take.channels = make_channels(poses, *subject.skeleton);
  set_layout(made.take);

  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const PlannedOccurrence& occurrence = planned.occurrences[i];
    const auto seconds = [&](long frame) {
      return static_cast<double>(frame) / made.take.frame_rate;
    };
    made.occurrences.push_back({occurrence.motif,
                                occurrence.place,
                                {planned.name, seconds(intervals[i].first),
                                 seconds(intervals[i].last), occurrence.speed, occurrence.noise}});
  }
  return made;
}

}  // namespace reprise::synth

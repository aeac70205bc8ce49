#include "synth/footsteps.h"

#include <algorithm>
#include <cmath>

namespace reprise::synth {
namespace {

void write_step(TrackMatrix& tracks, const Footstep& step) {
  const double rate = Performance::rate;
  const int x = foot_track(step.side, foot_x);
  const int z = foot_track(step.side, foot_z);
  const int yaw = foot_track(step.side, foot_yaw);
  const long first = std::max(0L, static_cast<long>(std::floor(step.start * rate)));
  if (first >= tracks.rows()) return;
  const double from_x = tracks(first, x), from_z = tracks(first, z), from_yaw = tracks(first, yaw);
  for (long sample = first; sample < tracks.rows(); ++sample) {
    const double u = (static_cast<double>(sample) / rate - step.start) / (step.end - step.start);
    const double done = minimum_jerk(u);
    tracks(sample, x) = from_x + done * (step.x - from_x);
    tracks(sample, z) = from_z + done * (step.z - from_z);
    tracks(sample, yaw) = from_yaw + done * (step.yaw - from_yaw);
    if (u > 0 && u < 1) {
      const double bump = std::sin(pi * std::pow(u, 0.85));
      tracks(sample, foot_track(step.side, foot_lift)) = step.lift * bump * bump;
    }
  }
}

/// Heel rise before and toe rise after the flight, as keys around each step.
void write_pitch(Performance& performance, Side side, const std::vector<Footstep>& steps) {
  std::vector<Key> keys;
  double landed = -1;
  for (const Footstep& step : steps) {
    if (step.side != side) continue;
    const double flight = step.end - step.start;
    const double heel_off = std::max(step.start - 0.45 * flight, landed + 0.02);
    keys.push_back({heel_off, 0});
    keys.push_back({step.start + 0.06 * flight, step.push_off});
    keys.push_back({step.start + 0.55 * flight, 0.1 * step.push_off});
    keys.push_back({step.start + 0.92 * flight, -step.strike});
    landed = step.end + 0.25 * flight;
    keys.push_back({landed, 0});
  }
  const auto out_of_order = [](const Key& a, const Key& b) { return b.time <= a.time; };
  keys.erase(std::unique(keys.begin(), keys.end(), out_of_order), keys.end());
  performance.add_keys(foot_track(side, foot_pitch), keys);
}

/// How much of the weight a foot carries: less while it is lifted.
double foot_weight(const TrackMatrix& tracks, long sample, Side side, double sway) {
  return 1 -
         2 * sway * std::min(1.0, tracks(sample, foot_track(side, foot_lift)) / 0.05) / (1 + sway);
}

}  // namespace

GaitStyle random_walk_style(Random& random) {
  GaitStyle style;
  style.step_seconds = random.uniform(0.48, 0.60);
  style.step_length = random.uniform(0.68, 0.88);
  style.step_width = random.uniform(0.06, 0.12);
  style.lift = random.uniform(0.05, 0.10);
  style.push_off = random.uniform(32, 50);
  style.strike = random.uniform(8, 20);
  style.sway = random.uniform(0.12, 0.30);
  style.arm_swing = random.uniform(12, 38);
  style.elbow_bend = random.uniform(5, 30);
  style.pelvis_turn = random.uniform(4, 10);
  style.lean = random.uniform(-1, 7);
  return style;
}

GaitStyle random_run_style(Random& random) {
  GaitStyle style;
  style.step_seconds = random.uniform(0.33, 0.40);
  style.step_length = random.uniform(1.0, 1.4);
  style.step_width = random.uniform(0.04, 0.08);
  style.swing_share = random.uniform(1.2, 1.35);
  style.lift = random.uniform(0.22, 0.36);
  style.push_off = random.uniform(55, 75);
  style.strike = random.uniform(2, 8);
  style.bob = random.uniform(0.035, 0.06);
  style.sway = 0.08;
  style.arm_swing = random.uniform(35, 55);
  style.elbow_bend = random.uniform(60, 90);
  style.pelvis_turn = random.uniform(6, 12);
  style.lean = random.uniform(6, 14);
  style.crouch = random.uniform(0.02, 0.05);
  return style;
}

void apply_footsteps(Performance& performance, const std::vector<Footstep>& steps) {
  for (const Footstep& step : steps) write_step(performance.tracks(), step);
  for (const Side side : {Side::left, Side::right}) write_pitch(performance, side, steps);
}

void follow_feet(Performance& performance, const GaitStyle& style) {
  TrackMatrix& tracks = performance.tracks();
  const long n = tracks.rows();
  const double sigma = 0.32 * style.step_seconds * Performance::rate;
  Eigen::VectorXd x(n), z(n), yaw(n), reach(n);
  for (long i = 0; i < n; ++i) {
    const double left = foot_weight(tracks, i, Side::left, style.sway);
    const double right = foot_weight(tracks, i, Side::right, style.sway);
    const auto mean = [&](FootTrack track) {
      return (left * tracks(i, foot_track(Side::left, track)) +
              right * tracks(i, foot_track(Side::right, track))) /
             (left + right);
    };
    x[i] = mean(foot_x);
    z[i] = mean(foot_z);
    yaw[i] = 0.5 * (tracks(i, foot_track(Side::left, foot_yaw)) +
                    tracks(i, foot_track(Side::right, foot_yaw)));
  }
  for (auto* column : {&x, &z, &yaw}) smooth_column(*column, sigma);
  for (long i = 0; i < n; ++i) {
    const double heading = yaw[i] * radians_per_degree;
    const double dx =
        tracks(i, foot_track(Side::right, foot_x)) - tracks(i, foot_track(Side::left, foot_x));
    const double dz =
        tracks(i, foot_track(Side::right, foot_z)) - tracks(i, foot_track(Side::left, foot_z));
    reach[i] = std::sin(heading) * dx + std::cos(heading) * dz;
  }
  smooth_column(reach, 0.5 * sigma);
  const double busy_from = 0.5 * style.step_seconds;
  for (long i = 0; i < n; ++i) {
    const double heading = yaw[i] * radians_per_degree;
    const double time = static_cast<double>(i) / Performance::rate;
    const double busy =
        minimum_jerk(time / busy_from) * minimum_jerk((performance.seconds() - time) / busy_from);
    tracks(i, pelvis_x) += x[i] + std::sin(heading) * pelvis_before_ankles;
    tracks(i, pelvis_z) += z[i] + std::cos(heading) * pelvis_before_ankles;
    tracks(i, pelvis_rise) -= 0.07 * reach[i] * reach[i] + busy * style.crouch;
    tracks(i, pelvis_yaw) += yaw[i] + style.pelvis_turn * reach[i];
    tracks(i, torso_twist) -= 1.6 * style.pelvis_turn * reach[i];
    tracks(i, torso_pitch) += busy * style.lean;
    tracks(i, head_pitch) -= 0.6 * busy * style.lean;
    for (const Side side : {Side::left, Side::right}) {
      const double forward = sign_of(side) * reach[i];
      tracks(i, arm_track(side, arm_y)) -= style.arm_swing * forward;
      tracks(i, arm_track(side, elbow)) +=
          busy * style.elbow_bend + 0.35 * style.arm_swing * forward;
    }
  }
}

Performance perform_steps(const GaitStyle& style, int steps, double turn, double direction,
                          Side first) {
  const double flight = style.swing_share * style.step_seconds;
  const double lead = 0.5 * flight + 0.02;  // time for the first heel to rise
  const double seconds =
      2 * lead + (steps - 1) * style.step_seconds + std::max(flight, style.step_seconds) + 0.12;
  Performance performance(seconds);
  std::vector<Footstep> plan;
  double x = 0, z = 0, heading = 0;
  Side side = first;
  for (int k = 0; k < steps; ++k, side = other(side)) {
    const bool closing = k + 1 == steps;
    const double length = closing ? 0 : (k == 0 ? 0.55 : 1.0) * style.step_length;
    heading += turn / steps;
    const double way = (heading + direction) * radians_per_degree;
    x += std::sin(way) * length;
    z += std::cos(way) * length;
    const double facing = heading * radians_per_degree;
    const double width =
        sign_of(side) * (closing || k + 2 == steps ? stance_half_width : style.step_width);
    Footstep step;
    step.side = side;
    step.start = lead + k * style.step_seconds;
    step.end = step.start + flight;
    step.x = x + std::cos(facing) * width - std::sin(facing) * pelvis_before_ankles;
    step.z = z - std::sin(facing) * width - std::cos(facing) * pelvis_before_ankles;
    step.yaw = heading + sign_of(side) * 7;
    const double vigour = k == 0 || closing ? 0.6 : 1.0;
    step.lift = vigour * style.lift;
    step.push_off = vigour * style.push_off;
    step.strike = closing ? 0 : style.strike;
    plan.push_back(step);
  }
  apply_footsteps(performance, plan);
  follow_feet(performance, style);
  if (style.bob > 0) {
    // Highest in the middle of the time when both feet are off the floor.
    const double phase = 0.5 * pi - 2 * pi * (0.1 + 0.5 * style.swing_share);
    performance.add_oscillation(
        pelvis_rise, {lead + 0.4 * style.step_seconds, lead + (steps - 0.5) * style.step_seconds,
                      1 / style.step_seconds, style.bob, phase});
  }
  return performance;
}

}  // namespace reprise::synth

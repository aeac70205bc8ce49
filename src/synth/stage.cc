#include "synth/stage.h"

#include <algorithm>
#include <cmath>

namespace reprise::synth {
namespace {

/// Someone further from the middle of the room than this (in legs) turns back.
constexpr double room_radius = 2.5;
constexpr double shortest_blend = 0.3, longest_blend = 0.6;  // seconds
constexpr double longest_steps = 0.95;                       // seconds for a blend with steps
constexpr double still_distance = 0.015;  // legs: a foot that goes less far slides
constexpr double still_turn = 3;          // degrees

double wrapped(double degrees) { return degrees - 360 * std::round(degrees / 360); }

double foot_distance(const TrackRow& a, const TrackRow& b, Side side) {
  const int x = foot_track(side, foot_x), z = foot_track(side, foot_z);
  return std::hypot(b[x] - a[x], b[z] - a[z]);
}

bool foot_moves(const TrackRow& a, const TrackRow& b, Side side) {
  const int yaw = foot_track(side, foot_yaw);
  return foot_distance(a, b, side) > still_distance || std::abs(b[yaw] - a[yaw]) > still_turn;
}

/// Place and turn of a foot that has done `share` of its step.
void step_foot(TrackRow& row, const TrackRow& a, const TrackRow& b, Side side, double share,
               bool lifted) {
  const double done = minimum_jerk(share);
  for (const FootTrack track : {foot_x, foot_z, foot_yaw}) {
    const int column = foot_track(side, track);
    row[column] = a[column] + done * (b[column] - a[column]);
  }
  if (lifted && share > 0 && share < 1) {
    const double bump = std::sin(pi * share);
    row[foot_track(side, foot_lift)] = (0.04 + 0.1 * foot_distance(a, b, side)) * bump * bump;
    row[foot_track(side, foot_pitch)] = 18 * std::sin(2 * pi * share) * bump;
  }
}

}  // namespace

Stage::Stage(double frame_rate, Random random)
    : frame_rate_(frame_rate), random_(random), tracks_(1024, track_count) {}

FrameInterval Stage::add(const Performance& performance, double speed, double turn) {
  const TrackRow first = performance.at(0);
  if (frames_ == 0) {
    heading_ = random_.uniform(-180, 180);
  } else {
    const TrackRow last = tracks_.row(frames_ - 1);
    place(first, turn);
    add_transition(last, placed(first));
  }
  FrameInterval interval;
  interval.first = frames_;
  interval.last = frames_ + std::max(2L, std::lround(performance.seconds() / speed * frame_rate_));
  for (long i = 0; i < interval.last - interval.first; ++i) {
    append(placed(performance.at(static_cast<double>(i) * speed / frame_rate_)));
  }
  return interval;
}

double Stage::choose_turn() {
  const double turn = random_.uniform(-60, 60);
  if (frames_ == 0) return turn;
  const TrackRow last = tracks_.row(frames_ - 1);
  if (std::hypot(last[pelvis_x], last[pelvis_z]) < room_radius) return turn;
  const double home = std::atan2(-last[pelvis_x], -last[pelvis_z]) / radians_per_degree;
  return std::clamp(wrapped(home - last[pelvis_yaw]), -100.0, 100.0) + 0.3 * turn;
}

/// A row in the performance's own directions, in those of the room.
TrackRow Stage::placed(TrackRow row) const {
  const double c = std::cos(heading_ * radians_per_degree),
               s = std::sin(heading_ * radians_per_degree);
  const auto move = [&](int x_column, int z_column) {
    const double x = row[x_column], z = row[z_column];
    row[x_column] = x_ + c * x + s * z;
    row[z_column] = z_ - s * x + c * z;
  };
  move(pelvis_x, pelvis_z);
  row[pelvis_yaw] += heading_;
  for (const Side side : {Side::left, Side::right}) {
    move(foot_track(side, foot_x), foot_track(side, foot_z));
    row[foot_track(side, foot_yaw)] += heading_;
  }
  return row;
}

/// The feet of a new performance start around the place where the feet stand now.
void Stage::place(const TrackRow& first, double turn) {
  const TrackRow last = tracks_.row(frames_ - 1);
  const auto middle = [](const TrackRow& row, FootTrack track) {
    return 0.5 * (row[foot_track(Side::left, track)] + row[foot_track(Side::right, track)]);
  };
  heading_ = middle(last, foot_yaw) + turn - middle(first, foot_yaw);
  x_ = z_ = 0;
  const TrackRow there = placed(first);
  x_ = middle(last, foot_x) - middle(there, foot_x);
  z_ = middle(last, foot_z) - middle(there, foot_z);
}

void Stage::add_transition(const TrackRow& from, const TrackRow& to) {
  const bool left = foot_moves(from, to, Side::left), right = foot_moves(from, to, Side::right);
  const double far =
      std::max(foot_distance(from, to, Side::left), foot_distance(from, to, Side::right));
  double seconds = random_.uniform(shortest_blend, longest_blend);
  if (left || right)
    seconds =
        std::min(longest_steps, std::max(seconds, 0.4 + 0.5 * far) + (left && right ? 0.2 : 0));
  const bool left_first = random_.chance(0.5);
  const long n = std::max(2L, std::lround(seconds * frame_rate_));
  for (long i = 1; i <= n; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(n + 1);
    TrackRow row = from + minimum_jerk(u) * (to - from);
    for (const Side side : {Side::left, Side::right}) {
      const bool both = left && right;
      const bool leads = (side == Side::left) == left_first;
      const double start = both ? (leads ? 0.0 : 0.47) : 0.1,
                   end = both ? (leads ? 0.53 : 1.0) : 0.9;
      step_foot(row, from, to, side, (u - start) / (end - start),
                side == Side::left ? left : right);
    }
    append(row);
  }
}

void Stage::append(const TrackRow& row) {
  if (frames_ == tracks_.rows()) tracks_.conservativeResize(2 * frames_, Eigen::NoChange);
  tracks_.row(frames_++) = row;
}

}  // namespace reprise::synth

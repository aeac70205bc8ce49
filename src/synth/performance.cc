#include "synth/performance.h"

#include <algorithm>
#include <cmath>

namespace reprise::synth {
namespace {

/// Slopes of the monotone cubic through the keys, flat at both ends.
std::vector<double> monotone_slopes(std::span<const Key> keys) {
  std::vector<double> slopes(keys.size(), 0.0);
  for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
    const double before = (keys[i].value - keys[i - 1].value) / (keys[i].time - keys[i - 1].time);
    const double after = (keys[i + 1].value - keys[i].value) / (keys[i + 1].time - keys[i].time);
    if (before * after > 0) slopes[i] = 2 * before * after / (before + after);
  }
  return slopes;
}

double hermite(const Key& a, const Key& b, double slope_a, double slope_b, double time) {
  const double span = b.time - a.time;
  const double u = (time - a.time) / span;
  const double u2 = u * u;
  const double u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * a.value + (u3 - 2 * u2 + u) * span * slope_a +
         (3 * u2 - 2 * u3) * b.value + (u3 - u2) * span * slope_b;
}

}  // namespace

TrackRow standing() {
  TrackRow row = TrackRow::Zero();
  row[pelvis_rise] = -0.012;
  for (const Side side : {Side::left, Side::right}) {
    const double sign = sign_of(side);
    row[foot_track(side, foot_x)] = sign * stance_half_width;
    row[foot_track(side, foot_z)] = -pelvis_before_ankles;
    row[foot_track(side, foot_yaw)] = sign * 7;
    row[arm_track(side, arm_y)] = -4;
    row[arm_track(side, arm_z)] = -75;
    row[arm_track(side, elbow)] = 15;
  }
  return row;
}

Performance::Performance(double seconds)
    : tracks_(std::max(2L, std::lround(seconds * rate) + 1), track_count) {
  tracks_.rowwise() = standing();
}

void Performance::add_keys(int track, std::span<const Key> keys) {
  if (keys.empty()) return;
  const std::vector<double> slopes = monotone_slopes(keys);
  std::size_t next = 0;  // the first key after the time
  for (long sample = 0; sample < tracks_.rows(); ++sample) {
    const double time = static_cast<double>(sample) / rate;
    while (next < keys.size() && keys[next].time <= time) ++next;
    double value = 0;
    if (next == 0) {
      value = keys.front().value;
    } else if (next == keys.size()) {
      value = keys.back().value;
    } else {
      value = hermite(keys[next - 1], keys[next], slopes[next - 1], slopes[next], time);
    }
    tracks_(sample, track) += value;
  }
}

void Performance::set_keys(int track, std::span<const Key> keys) {
  tracks_.col(track).setZero();
  add_keys(track, keys);
}

void Performance::add_oscillation(int track, const Oscillation& oscillation) {
  const auto& [from, to, frequency, amplitude, phase] = oscillation;
  const double fade = std::min(0.25, 0.3 * (to - from));
  for (long sample = 0; sample < tracks_.rows(); ++sample) {
    const double time = static_cast<double>(sample) / rate;
    const double envelope = minimum_jerk((time - from) / fade) * minimum_jerk((to - time) / fade);
    if (envelope > 0) {
      tracks_(sample, track) +=
          envelope * amplitude * std::sin(2 * pi * frequency * (time - from) + phase);
    }
  }
}

TrackRow Performance::at(double time) const {
  const long last = tracks_.rows() - 1;
  const double place = std::clamp(time * rate, 0.0, static_cast<double>(last));
  const long i = std::min(static_cast<long>(place), last - 1);
  const double u = place - static_cast<double>(i);
  const auto before = tracks_.row(std::max(0L, i - 1));
  const auto after = tracks_.row(std::min(last, i + 2));
  const double u2 = u * u;
  const double u3 = u2 * u;
  return 0.5 * ((2 * u2 - u - u3) * before + (2 - 5 * u2 + 3 * u3) * tracks_.row(i) +
                (u + 4 * u2 - 3 * u3) * tracks_.row(i + 1) + (u3 - u2) * after);
}

void Performance::smooth(int first, int last, double sigma) {
  for (int track = first; track < last; ++track) {
    Eigen::VectorXd column = tracks_.col(track);
    smooth_column(column, sigma * rate);
    // The ends stay as they are, at rest.
    for (long i = 0; i < column.size(); ++i) {
      const double inside = static_cast<double>(std::min(i, column.size() - 1 - i));
      const double weight = minimum_jerk(inside / (4 * sigma * rate));
      tracks_(i, track) += weight * (column[i] - tracks_(i, track));
    }
  }
}

double minimum_jerk(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

void smooth_column(Eigen::Ref<Eigen::VectorXd> column, double sigma) {
  const long n = column.size();
  const long reach = std::max(1L, std::lround(3 * sigma));
  Eigen::VectorXd weights(2 * reach + 1);
  for (long k = -reach; k <= reach; ++k) {
    const double u = static_cast<double>(k) / sigma;
    weights[k + reach] = std::exp(-0.5 * u * u);
  }
  weights /= weights.sum();
  Eigen::VectorXd padded(n + 2 * reach);
  padded.head(reach).setConstant(column[0]);
  padded.segment(reach, n) = column;
  padded.tail(reach).setConstant(column[n - 1]);
  for (long i = 0; i < n; ++i) column[i] = weights.dot(padded.segment(i, 2 * reach + 1));
}

}  // namespace reprise::synth

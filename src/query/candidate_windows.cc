#include "query/candidate_windows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "model/symmetric_eigen.h"

namespace reprise {
namespace {

using K = CandidateConstants;

/// Frames of a track between samples of a window.
constexpr long frame_step = static_cast<long>(K::spacing * PostureConstants::rate + 0.5);
constexpr long frame_hop = static_cast<long>(K::library_hop * PostureConstants::rate + 0.5);

PointMatrix all_postures(const PostureTrack& track) {
  const Stretch whole{0, static_cast<double>(track.frames() - 1) / PostureConstants::rate};
  return postures(track, whole, static_cast<int>(track.frames()),
                  LikenessConstants::bearing_taken_out);
}

/// First frames of a track's windows; a track shorter than a window has one, too.
long window_count(long frames) {
  return std::max(0L, frames - 1 - frame_step * (K::samples - 1)) / frame_hop + 1;
}

/// The samples of one window side by side; past the end the last row again.
Eigen::RowVectorXf window_of(const PointMatrix& rows, long first) {
  Eigen::RowVectorXf window(rows.cols() * K::samples);
  for (long i = 0; i < K::samples; ++i) {
    const long row = std::min(first + i * frame_step, rows.rows() - 1);
    window.segment(i * rows.cols(), rows.cols()) = rows.row(row);
  }
  return window;
}

/// Every nth of `count` things, so that about `training_rows` remain.
long training_stride(long count) { return std::max(1L, count / K::training_rows); }

RowBasis basis_of_postures(const std::vector<const PostureTrack*>& tracks) {
  long total = 0;
  for (const PostureTrack* track : tracks) total += track->frames();
  const long stride = training_stride(total);
  std::vector<float> chosen;
  long at = 0;
  for (const PostureTrack* track : tracks) {
    for (long f = (stride - at % stride) % stride; f < track->frames(); f += stride) {
      const double time = static_cast<double>(f) / PostureConstants::rate;
      const BodyPostures row =
          postures(*track, {time, time}, 1, LikenessConstants::bearing_taken_out);
      chosen.insert(chosen.end(), row.data(), row.data() + row.size());
    }
    at += track->frames();
  }
  const long rows = static_cast<long>(chosen.size()) / posture_size;
  return RowBasis::of(Eigen::Map<const PointMatrix>(chosen.data(), rows, posture_size),
                      K::posture_axes);
}

/// A vote for a stretch of a track that begins about there, at one speed.
struct Vote {
  std::uint32_t track;
  std::uint32_t speed;
  long bin;
  double begin;
  double weight;
};

bool same_bin(const Vote& a, const Vote& b) {
  return a.track == b.track && a.speed == b.speed && a.bin == b.bin;
}

/// Adds up the votes of each bin; the start is the mean of theirs.
std::vector<Candidate> count_votes(std::vector<Vote> votes, double seconds) {
  std::ranges::sort(votes, [](const Vote& a, const Vote& b) {
    return std::tie(a.track, a.speed, a.bin, a.begin, a.weight) <
           std::tie(b.track, b.speed, b.bin, b.begin, b.weight);
  });
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < votes.size();) {
    double weight = 0, begin = 0;
    const Vote& first = votes[i];
    for (; i < votes.size() && same_bin(votes[i], first); ++i) {
      weight += votes[i].weight;
      begin += votes[i].weight * votes[i].begin;
    }
    begin /= weight;
    const double length = seconds / K::speeds[first.speed];
    candidates.push_back({first.track, {begin, begin + length}, weight});
  }
  return candidates;
}

/// The most votes first; of those that overlap in a track the first one stays.
std::vector<Candidate> best_candidates(std::vector<Candidate> candidates, std::size_t count) {
  std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
    return std::tuple(-a.votes, a.track, a.stretch.begin, a.stretch.end) <
           std::tuple(-b.votes, b.track, b.stretch.begin, b.stretch.end);
  });
  std::map<std::size_t, std::vector<Stretch>> taken;
  std::vector<Candidate> best;
  for (const Candidate& candidate : candidates) {
    if (best.size() == count) break;
    std::vector<Stretch>& others = taken[candidate.track];
    const bool doubled = std::ranges::any_of(others, [&](const Stretch& other) {
      return covered(candidate.stretch, other) > K::most_candidate_overlap;
    });
    if (doubled) continue;
    others.push_back(candidate.stretch);
    best.push_back(candidate);
  }
  return best;
}

}  // namespace

double covered(const Stretch& stretch, const Stretch& other) {
  const double shared = std::min(stretch.end, other.end) - std::max(stretch.begin, other.begin);
  return stretch.seconds() > 0 ? std::max(0.0, shared / stretch.seconds()) : 0.0;
}

RowBasis RowBasis::of(const PointMatrix& rows, long most_axes) {
  RowBasis basis;
  basis.mean = rows.colwise().mean();
  const Eigen::MatrixXf centred = rows.rowwise() - basis.mean;
  const Eigen::MatrixXd covariance = (centred.transpose() * centred).cast<double>();
  const SymmetricEigen solved = symmetric_eigen(covariance);
  const long axes = std::min(most_axes, rows.cols());
  basis.axes = solved.vectors.rightCols(axes).cast<float>();
  return basis;
}

PointMatrix RowBasis::apply(const PointMatrix& rows) const {
  return (rows.rowwise() - mean) * axes;
}

CandidateWindows::CandidateWindows(std::vector<const PostureTrack*> tracks)
    : tracks_(std::move(tracks)), index_(PointMatrix(0, K::window_axes)) {
  if (tracks_.empty()) return;
  postures_ = basis_of_postures(tracks_);
  long total = 0;
  for (const PostureTrack* track : tracks_) total += window_count(track->frames());
  PointMatrix rows(total, K::samples * postures_.axes.cols());
  long at = 0;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const PointMatrix reduced = postures_.apply(all_postures(*tracks_[t]));
    for (long w = 0; w < window_count(tracks_[t]->frames()); ++w) {
      rows.row(at++) = window_of(reduced, w * frame_hop);
      track_of_.push_back(static_cast<std::uint32_t>(t));
      begin_of_.push_back(static_cast<float>(w) * static_cast<float>(K::library_hop));
    }
  }
  const long stride = training_stride(total);
  PointMatrix training((total + stride - 1) / stride, rows.cols());
  for (long i = 0; i < training.rows(); ++i) training.row(i) = rows.row(i * stride);
  windows_ = RowBasis::of(training, K::window_axes);
  index_ = WindowIndex(windows_.apply(rows));
}

std::vector<Neighbour> CandidateWindows::accepted_neighbours(
    std::span<const float> point, const std::vector<bool>& accept) const {
  for (std::size_t asked = K::neighbours;; asked *= 4) {
    std::vector<Neighbour> near = index_.nearest(point, asked);
    const bool last = near.size() < asked || asked >= K::most_neighbours_seen;
    std::erase_if(near, [&](const Neighbour& n) { return !accept[track_of_[n.point]]; });
    if (near.size() > K::neighbours) near.resize(K::neighbours);
    if (last || near.size() == K::neighbours) return near;
  }
}

std::vector<Candidate> CandidateWindows::find(const PostureTrack& query, const Stretch& stretch,
                                              std::size_t count,
                                              const std::vector<bool>& accept) const {
  std::vector<Vote> votes;
  for (std::uint32_t s = 0; s < K::speeds.size(); ++s) {
    const double speed = K::speeds[s];
    const double room = std::max(0.0, stretch.seconds() - K::span * speed);
    const int windows = std::min(static_cast<int>(room / K::query_hop) + 1, K::most_query_windows);
    for (int w = 0; w < windows; ++w) {
      const double offset = windows > 1 ? room * w / (windows - 1) : 0.0;
      const double begin = stretch.begin + offset;
      const PointMatrix samples =
          postures_.apply(postures(query, {begin, begin + K::span * speed}, K::samples,
                                   LikenessConstants::bearing_taken_out));
      const Eigen::Map<const PointMatrix> flat(samples.data(), 1, samples.size());
      const PointMatrix point = windows_.apply(flat);
      const std::vector<Neighbour> near =
          accepted_neighbours({point.data(), static_cast<std::size_t>(point.size())}, accept);
      const double furthest = near.empty() ? 0.0 : std::sqrt(near.back().squared_distance);
      for (const Neighbour& n : near) {
        const double begins = double{begin_of_[n.point]} - offset / speed;
        const double weight =
            1e-3 + (furthest > 0 ? 1 - std::sqrt(n.squared_distance) / furthest : 1);
        const double place = begins / K::vote_bin;
        for (const long bin : {std::lround(std::floor(place)), std::lround(std::ceil(place))}) {
          votes.push_back({track_of_[n.point], s, bin, begins, weight});
        }
      }
    }
  }
  return best_candidates(count_votes(std::move(votes), stretch.seconds()), count);
}

}  // namespace reprise

// Where in a library a part of a motion may occur: windows of motion near to windows of the query.
#pragma once

#include <vector>

#include "query/likeness.h"
#include "query/window_index.h"

namespace reprise {

struct CandidateConstants {
  /// A window is this many postures, so many seconds apart.
  static constexpr int samples = 5;
  static constexpr double spacing = 0.2;
  static constexpr double span = spacing * (samples - 1);
  static constexpr double library_hop = 0.4;
  static constexpr double query_hop = 0.2;
  static constexpr int most_query_windows = 24;
  /// Seconds of the query in a second of the library.
  static constexpr std::array speeds = {0.5, 0.71, 1.0, 1.41, 2.0};
  static constexpr long posture_axes = 12;
  static constexpr long window_axes = 16;
  /// Axes are found from this many postures and windows, spread evenly over the library.
  static constexpr long training_rows = 4096;
  /// Windows of the library that a window of the query votes for.
  static constexpr std::size_t neighbours = 100;
  /// Where most of the nearest are of tracks that are left out, this many are looked at for it.
  static constexpr std::size_t most_neighbours_seen = 1600;
  /// Votes for starts about this near (s) go together.
  static constexpr double vote_bin = 0.4;
  /// The same of candidates, which may still move.
  static constexpr double most_candidate_overlap = 0.8;
  /// Of two stretches of a take that share more than this part of the shorter one, the better
  /// stays.
  static constexpr double most_overlap = 0.5;
};

/// A stretch of the track with this index.
struct Candidate {
  std::size_t track = 0;
  Stretch stretch;
  double votes = 0;
};

/// The part of a stretch that the other one covers.
double covered(const Stretch& stretch, const Stretch& other);

/// Principal axes of rows.
struct RowBasis {
  Eigen::RowVectorXf mean;
  Eigen::MatrixXf axes;  ///< columns x axes

  static RowBasis of(const PointMatrix& rows, long most_axes);
  PointMatrix apply(const PointMatrix& rows) const;
};

/// Windows of the tracks, which must stay alive and have one plan. Principal axes of postures and
/// then of windows leave few numbers of each, which WindowIndex searches.
class CandidateWindows {
 public:
  explicit CandidateWindows(std::vector<const PostureTrack*> tracks);

  /// At most `count` stretches, at half to twice the speed of the query's, the most votes first.
  /// Tracks that `accept` (as many as tracks) says no of are left out.
  std::vector<Candidate> find(const PostureTrack& query, const Stretch& stretch, std::size_t count,
                              const std::vector<bool>& accept) const;

 private:
  /// The `neighbours` windows of accepted tracks that are nearest to a point; fewer, if there are
  /// fewer among the nearest `most_neighbours_seen` of all.
  std::vector<Neighbour> accepted_neighbours(std::span<const float> point,
                                             const std::vector<bool>& accept) const;

  std::vector<const PostureTrack*> tracks_;
  RowBasis postures_;
  RowBasis windows_;
  std::vector<std::uint32_t> track_of_;  ///< of each window
  std::vector<float> begin_of_;          ///< seconds
  WindowIndex index_;
};

}  // namespace reprise

// Nearest neighbours among points of a few dozen numbers: features of windows of motion.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace reprise {

/// points x dimensions, row-major.
using PointMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A point of the index, and how far it is from the one that was asked for.
struct Neighbour {
  std::uint32_t point = 0;
  double squared_distance = 0;

  friend bool operator<(const Neighbour& a, const Neighbour& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                    : a.point < b.point;
  }
  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// An exact kd-tree over points (FLANN's KDTreeSingleIndex). Answers are those of a linear scan:
/// nearest first, and of points at the same distance the one with the smaller index. It is made in
/// memory whenever it is needed, never stored. Asking is safe from many threads at once.
class WindowIndex {
 public:
  /// All numbers must be finite. `points` may have no rows.
  explicit WindowIndex(PointMatrix points);
  ~WindowIndex();
  WindowIndex(WindowIndex&&) noexcept;
  WindowIndex& operator=(WindowIndex&&) noexcept;

  const PointMatrix& points() const { return points_; }

  /// The `count` points nearest to `query` (as many numbers as a point has); all, if there are
  /// fewer.
  std::vector<Neighbour> nearest(std::span<const float> query, std::size_t count) const;

  static constexpr long every_look = std::numeric_limits<long>::max();
  /// At most `count` points less than `most` away, nearest first. The one of each rank is at most
  /// `excess` (1 or more) times as far as the one that is truly of that rank; where there are fewer
  /// than `count`, only points further than most / excess are missing. Looks at far fewer points
  /// than `nearest` does where there are many, and into no more than `most_looks` parts of the
  /// tree, nearest parts first: where these are too few, nearer points may be missing. The same
  /// points have the same answers.
  std::vector<Neighbour> nearly_nearest(std::span<const float> query, std::size_t count,
                                        double most, double excess,
                                        long most_looks = every_look) const;

  /// All points at most `distance` away.
  std::vector<Neighbour> within(std::span<const float> query, double distance) const;

 private:
  struct Tree;

  PointMatrix points_;
  std::unique_ptr<Tree> tree_;
};

/// What `WindowIndex` answers, by looking at every point.
std::vector<Neighbour> nearest_by_scan(const PointMatrix& points, std::span<const float> query,
                                       std::size_t count);

}  // namespace reprise

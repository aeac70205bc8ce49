#include "query/window_index.h"

#include <algorithm>
#include <cassert>
#include <cmath>

// Of FLANN's headers only what this index needs.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#endif
#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace reprise {
namespace {

/// FLANN compares sums of rounded numbers: it looks this much further (of a squared distance), and
/// what it finds is measured again.
constexpr double rounding_margin = 1e-4;
/// Points in a leaf.
constexpr int leaf_size = 16;
/// Of FLANN's tree, with what its blocks leave unused.
constexpr std::size_t bytes_of_node = 64;

double squared_distance(std::span<const float> a, const float* b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = double{a[i]} - double{b[i]};
    sum += difference * difference;
  }
  return sum;
}

void keep_nearest(std::vector<Neighbour>& neighbours, std::size_t count) {
  const std::size_t kept = std::min(count, neighbours.size());
  std::partial_sort(neighbours.begin(), neighbours.begin() + static_cast<std::ptrdiff_t>(kept),
                    neighbours.end());
  neighbours.resize(kept);
}

/// Collects the `count` nearest within a squared distance.
class NearestWithin final : public flann::ResultSet<float> {
 public:
  NearestWithin(std::size_t count, float squared, long most_looks)
      : count_(count), worst_(squared), looks_left_(most_looks) {
    found_.reserve(count);
  }

  bool full() const override { return true; }  // never look further than worstDist
  /// FLANN asks before it looks into a part of the tree.
  float worstDist() const override { return looks_left_-- > 0 ? worst_ : nowhere; }
  void addPoint(float squared, std::size_t point) override {
    if (!(squared < worst_)) return;
    const std::pair<float, std::size_t> entry(squared, point);
    if (found_.size() == count_) found_.pop_back();
    found_.insert(std::upper_bound(found_.begin(), found_.end(), entry), entry);
    if (found_.size() == count_) worst_ = found_.back().first;
  }

  const std::vector<std::pair<float, std::size_t>>& found() const { return found_; }

 private:
  static constexpr float nowhere = -1;

  std::size_t count_;
  float worst_;
  mutable long looks_left_;
  std::vector<std::pair<float, std::size_t>> found_;
};

}  // namespace

struct WindowIndex::Tree {
  using Distance = flann::L2<float>;

  explicit Tree(PointMatrix& points)
      : index(flann::Matrix<float>(points.data(), static_cast<std::size_t>(points.rows()),
                                   static_cast<std::size_t>(points.cols())),
              flann::KDTreeSingleIndexParams(leaf_size)) {
    see_to_memory(static_cast<std::size_t>(points.rows()));
    index.buildIndex();
  }

  /// FLANN does not look whether it gets the memory for its nodes. Throws std::bad_alloc where
  /// there is none.
  static void see_to_memory(std::size_t points) {
    const std::size_t nodes = 4 * points / leaf_size + 2;  // leaves are half full at least
    ::operator delete(::operator new(nodes* bytes_of_node));
  }

  /// The points that may be within a squared distance, in any order.
  std::vector<Neighbour> candidates(const PointMatrix& points, std::span<const float> query,
                                    double squared) const {
    const double reach = squared * (1 + rounding_margin) + 1e-30;
    flann::RadiusResultSet<float> found(static_cast<float>(reach));
    index.findNeighbors(found, query.data(), parameters());
    std::vector<std::size_t> ids(found.size());
    std::vector<float> distances(found.size());
    if (!ids.empty()) found.copy(ids.data(), distances.data(), ids.size(), false);
    std::vector<Neighbour> neighbours;
    neighbours.reserve(ids.size());
    for (const std::size_t id : ids) {
      neighbours.push_back({static_cast<std::uint32_t>(id),
                            squared_distance(query, points.row(static_cast<long>(id)).data())});
    }
    return neighbours;
  }

  /// An upper bound of the squared distance of the nearest point number `count`.
  double reach_of(std::span<const float> query, std::size_t count) const {
    flann::KNNResultSet2<float> found(count);
    index.findNeighbors(found, query.data(), parameters());
    return found.worstDist();
  }

  static flann::SearchParams parameters() {
    return flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED);
  }

  flann::KDTreeSingleIndex<Distance> index;
};

WindowIndex::WindowIndex(PointMatrix points) : points_(std::move(points)) {
  assert(points_.allFinite());
  if (points_.size() > 0) tree_ = std::make_unique<Tree>(points_);
}
WindowIndex::~WindowIndex() = default;
WindowIndex::WindowIndex(WindowIndex&&) noexcept = default;
WindowIndex& WindowIndex::operator=(WindowIndex&&) noexcept = default;

std::vector<Neighbour> WindowIndex::nearest(std::span<const float> query, std::size_t count) const {
  assert(static_cast<long>(query.size()) == points_.cols());
  if (!tree_ || count == 0) return {};
  if (count >= static_cast<std::size_t>(points_.rows())) {
    return nearest_by_scan(points_, query, count);
  }
  std::vector<Neighbour> neighbours =
      tree_->candidates(points_, query, tree_->reach_of(query, count));
  keep_nearest(neighbours, count);
  return neighbours;
}

std::vector<Neighbour> WindowIndex::nearly_nearest(std::span<const float> query, std::size_t count,
                                                   double most, double excess,
                                                   long most_looks) const {
  assert(static_cast<long>(query.size()) == points_.cols());
  assert(excess >= 1);
  if (!tree_ || count == 0 || !(most >= 0)) return {};
  NearestWithin set(count, static_cast<float>(most * most), most_looks);
  tree_->index.findNeighbors(
      set, query.data(),
      flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED, static_cast<float>(excess * excess - 1)));
  std::vector<Neighbour> neighbours;
  for (const auto& [squared, point] : set.found()) {
    const float* const place = points_.row(static_cast<long>(point)).data();
    neighbours.push_back({static_cast<std::uint32_t>(point), squared_distance(query, place)});
  }
  std::sort(neighbours.begin(), neighbours.end());
  return neighbours;
}

std::vector<Neighbour> WindowIndex::within(std::span<const float> query, double distance) const {
  assert(static_cast<long>(query.size()) == points_.cols());
  if (!tree_ || !(distance >= 0)) return {};
  const double squared = distance * distance;
  std::vector<Neighbour> neighbours = tree_->candidates(points_, query, squared);
  std::erase_if(neighbours, [&](const Neighbour& n) { return n.squared_distance > squared; });
  std::sort(neighbours.begin(), neighbours.end());
  return neighbours;
}

std::vector<Neighbour> nearest_by_scan(const PointMatrix& points, std::span<const float> query,
                                       std::size_t count) {
  std::vector<Neighbour> neighbours;
  for (long i = 0; i < points.rows(); ++i) {
    neighbours.push_back(
        {static_cast<std::uint32_t>(i), squared_distance(query, points.row(i).data())});
  }
  keep_nearest(neighbours, count);
  return neighbours;
}

}  // namespace reprise

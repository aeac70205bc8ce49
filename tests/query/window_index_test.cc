#include "query/window_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

namespace reprise {
namespace {

/// Points on a coarse grid: many of them are at equal distances, and many are equal.
PointMatrix grid_points(long count, long dimensions, int values, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> cells(0, values - 1);
  return PointMatrix::NullaryExpr(count, dimensions,
                                  [&] { return 0.1f * static_cast<float>(cells(random)); });
}

PointMatrix smooth_points(long count, long dimensions, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> values(0, 100);
  return PointMatrix::NullaryExpr(count, dimensions, [&] { return values(random); });
}

std::span<const float> row(const PointMatrix& points, long i) {
  return {points.row(i).data(), static_cast<std::size_t>(points.cols())};
}

void expect_like_scan(const PointMatrix& points, const PointMatrix& queries) {
  const WindowIndex index(points);
  for (long q = 0; q < queries.rows(); ++q) {
    for (const std::size_t count : {1u, 2u, 7u, 40u, 5000u}) {
      const auto expected = nearest_by_scan(points, row(queries, q), count);
      ASSERT_EQ(index.nearest(row(queries, q), count), expected) << "query " << q;
    }
    auto all = nearest_by_scan(points, row(queries, q), static_cast<std::size_t>(points.rows()));
    const double distance = std::sqrt(all[all.size() / 3].squared_distance);
    std::erase_if(all,
                  [&](const Neighbour& n) { return n.squared_distance > distance * distance; });
    ASSERT_EQ(index.within(row(queries, q), distance), all) << "query " << q;
  }
}

TEST(WindowIndex, AnswersAreThoseOfALinearScan) {
  expect_like_scan(smooth_points(3000, 15, 1), smooth_points(40, 15, 2));
}

TEST(WindowIndex, EqualDistancesComeInTheOrderOfPoints) {
  expect_like_scan(grid_points(3000, 4, 4, 3), grid_points(40, 4, 4, 4));
  expect_like_scan(grid_points(500, 2, 1, 5), grid_points(3, 2, 4, 6));
}

TEST(WindowIndex, DistancesOfManyMagnitudesKeepTheirOrder) {
  PointMatrix points = smooth_points(2000, 8, 7);
  for (long i = 0; i < points.rows(); ++i) points.row(i) *= std::pow(2.0f, float(i % 40) - 20.0f);
  expect_like_scan(points, points.topRows(40));
}

TEST(WindowIndex, FindsThePointItself) {
  const PointMatrix points = smooth_points(1000, 24, 8);
  const WindowIndex index(points);
  for (long i = 0; i < points.rows(); ++i) {
    const auto found = index.nearest(row(points, i), 1);
    ASSERT_EQ(found.size(), 1u);
    ASSERT_EQ(found[0], (Neighbour{static_cast<std::uint32_t>(i), 0.0}));
  }
}

TEST(WindowIndex, NearlyNearestAreNoFurtherThanTheExcess) {
  constexpr std::size_t count = 8;
  const PointMatrix points = smooth_points(3000, 6, 11), queries = smooth_points(40, 6, 12);
  const WindowIndex index(points);
  for (long q = 0; q < queries.rows(); ++q) {
    const auto nearest = index.nearest(row(queries, q), count);
    EXPECT_EQ(index.nearly_nearest(row(queries, q), count, 1e6, 1), nearest);
    for (const double excess : {1.5, 3.0}) {
      const auto nearly = index.nearly_nearest(row(queries, q), count, 1e6, excess);
      ASSERT_EQ(nearly.size(), count);
      EXPECT_TRUE(std::is_sorted(nearly.begin(), nearly.end()));
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_LE(std::sqrt(nearly[i].squared_distance),
                  1.001 * excess * std::sqrt(nearest[i].squared_distance));
      }
    }
  }
}

TEST(WindowIndex, NearlyNearestAreWithinTheDistance) {
  const PointMatrix points = smooth_points(3000, 6, 13), queries = smooth_points(40, 6, 14);
  const WindowIndex index(points);
  std::size_t found = 0;
  for (long q = 0; q < queries.rows(); ++q) {
    constexpr double most = 150, excess = 2;
    const auto all = index.within(row(queries, q), most);
    const auto nearly = index.nearly_nearest(row(queries, q), 5000, most, excess);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), nearly.begin(), nearly.end()));
    for (const Neighbour& sure : index.within(row(queries, q), 0.999 * most / excess)) {
      EXPECT_TRUE(std::binary_search(nearly.begin(), nearly.end(), sure));
    }
    found += nearly.size();
  }
  EXPECT_GT(found, 0u);
}

TEST(WindowIndex, AFewLooksFindPointsThatAreNearMoreFindNearerOnes) {
  constexpr std::size_t count = 8;
  constexpr double most = 1e6, excess = 1.5;
  const PointMatrix points = smooth_points(3000, 6, 15), queries = smooth_points(40, 6, 16);
  const WindowIndex index(points);
  std::size_t found_by_few = 0;
  for (long q = 0; q < queries.rows(); ++q) {
    const auto query = row(queries, q);
    const auto all = index.within(query, most);
    const auto unlimited = index.nearly_nearest(query, count, most, excess);
    EXPECT_TRUE(index.nearly_nearest(query, count, most, excess, 0).empty());
    EXPECT_EQ(index.nearly_nearest(query, count, most, excess, points.rows()), unlimited);
    const auto few = index.nearly_nearest(query, count, most, excess, 12);
    EXPECT_TRUE(std::includes(all.begin(), all.end(), few.begin(), few.end()));
    for (std::size_t i = 0; i < few.size(); ++i) {
      EXPECT_GE(few[i].squared_distance, unlimited[i].squared_distance);
    }
    found_by_few += few.size();
  }
  EXPECT_GT(found_by_few, 0u);
}

TEST(WindowIndex, WithoutPointsThereIsNothingNear) {
  const WindowIndex index(PointMatrix(0, 5));
  const std::vector<float> query(5, 0.0f);
  EXPECT_TRUE(index.nearest(query, 3).empty());
  EXPECT_TRUE(index.within(query, 1e9).empty());
  EXPECT_TRUE(index.nearly_nearest(query, 3, 1e9, 2).empty());
}

TEST(WindowIndex, OtherIndicesAndThreadsChangeNothing) {
  const PointMatrix points = smooth_points(2000, 12, 9);
  WindowIndex first(points);
  const WindowIndex other(smooth_points(500, 12, 10));
  const WindowIndex moved(std::move(first));
  std::vector<std::vector<Neighbour>> answers(4);
  {
    std::vector<std::jthread> threads;
    for (auto& answer : answers) {
      threads.emplace_back([&] { answer = moved.nearest(row(points, 17), 25); });
    }
  }
  for (const auto& answer : answers)
    EXPECT_EQ(answer, nearest_by_scan(points, row(points, 17), 25));
}

}  // namespace
}  // namespace reprise

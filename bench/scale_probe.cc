// What an open archive answers how fast: searches for parts of takes, and takes by their names.
//
// usage: reprise_scale_probe ARCHIVE [QUERIES]
// Prints one JSON document; times in milliseconds.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "reprise/query/motion_search.h"

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

nlohmann::json summary(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return {{"median", times[times.size() / 2]},
          {"p95", times[times.size() * 95 / 100]},
          {"greatest", times.back()}};
}

}  // namespace

int main(int argc, char** argv) {
  constexpr double part_s = 2;
  if (argc < 2) return 2;
  const int queries = argc > 2 ? std::atoi(argv[2]) : 200;
  const reprise::Archive archive(argv[1]);
  const std::vector<reprise::TakeInfo> takes = archive.takes();
  std::mt19937 random(1);
  const auto any_take = [&]() -> const reprise::TakeInfo& {
    return takes[random() % takes.size()];
  };

  std::vector<double> extracts;
  archive.extract(takes.front());
  for (int i = 0; i < queries; ++i) {
    const std::string name = any_take().name;
    const auto start = Clock::now();
    archive.extract(archive.find_take(name));
    extracts.push_back(milliseconds_since(start));
  }

  const auto opening = Clock::now();
  reprise::MotionSearch search(argv[1]);
  const double opened = milliseconds_since(opening);
  std::vector<double> searches;
  double first = 0;
  for (int i = 0; i <= queries; ++i) {
    const reprise::TakeInfo& take = any_take();
    reprise::SearchOptions options;
    const double room = take.seconds() - part_s - 0.1;
    if (room > 0) {
      options.from = room * static_cast<double>(random() % 1000) / 1000;
      options.to = *options.from + part_s;
    }
    const auto start = Clock::now();
    search.like(take, options);
    if (i == 0) first = milliseconds_since(start);  // makes the index
    if (i > 0) searches.push_back(milliseconds_since(start));
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::cout << nlohmann::json{{"takes", takes.size()},
                              {"extract_ms", summary(extracts)},
                              {"open_ms", opened},
                              {"first_search_ms", first},
                              {"search_ms", summary(searches)},
                              {"peak_mib", static_cast<double>(usage.ru_maxrss) / 1024}}
                   .dump(1)
            << '\n';
}

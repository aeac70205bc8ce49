// Which ASF is an AMC's: neither says it, so that their names have to.
#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

enum class CharacterKind { letter, digit, other };

CharacterKind kind_of(char c) {
  if (c >= '0' && c <= '9') return CharacterKind::digit;
  const bool letter = (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80;
  return letter ? CharacterKind::letter : CharacterKind::other;
}

/// Of a file's name without its ending.
std::string lower_stem(const fs::path& path) {
  std::string stem = path.stem().string();
  for (char& c : stem) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return stem;
}

/// Words and numbers, parted by all else.
std::vector<std::string> words_of(const std::string& stem) {
  std::vector<std::string> words;
  CharacterKind before = CharacterKind::other;
  for (const char c : stem) {
    const CharacterKind kind = kind_of(c);
    if (kind != CharacterKind::other) {
      if (kind != before) words.emplace_back();
      words.back() += c;
    }
    before = kind;
  }
  return words;
}

/// Whether `amc` begins with `asf`, and a word or number of it ends there.
bool begins_with(const std::string& amc, const std::string& asf) {
  if (asf.empty() || !amc.starts_with(asf)) return false;
  return amc.size() == asf.size() || kind_of(asf.back()) == CharacterKind::other ||
         kind_of(amc[asf.size()]) != kind_of(asf.back());
}

/// Whether the words of `asf` are among those of `amc` in this order, the first one first.
bool has_words_of(const std::vector<std::string>& amc, const std::vector<std::string>& asf) {
  if (asf.empty() || amc.empty() || amc.front() != asf.front()) return false;
  auto at = amc.begin();
  return std::ranges::all_of(asf, [&](const std::string& word) {
    at = std::find(at, amc.end(), word);
    return at != amc.end() && at++ != amc.end();
  });
}

std::string listed(const std::vector<fs::path>& paths) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, paths.size()); ++i) {
    text += (i > 0 ? ", " : "") + paths[i].filename().string();
  }
  return text + (paths.size() > most ? ", ..." : "");
}

[[noreturn]] void reject(const fs::path& amc, const std::string& why) {
  throw Error(ErrorCode::rejected_input, why, {amc.string()}, "name one with --asf");
}

/// Those that fit best, by how much of the AMC's name they have.
using Fitting = std::map<std::size_t, std::vector<fs::path>>;

std::size_t best_fit(const Fitting& fitting) {
  return fitting.empty() ? 0 : fitting.rbegin()->first;
}

}  // namespace

std::optional<fs::path> choose_asf(const fs::path& amc, const std::vector<fs::path>& skeletons) {
  const std::string own = lower_stem(amc);
  const std::vector<std::string> words = words_of(own);
  Fitting beginnings, others;
  std::size_t words_of_beginning = 0;
  for (const fs::path& asf : skeletons) {
    const std::string stem = lower_stem(asf);
    const std::vector<std::string> its = words_of(stem);
    if (begins_with(own, stem)) {
      beginnings[stem.size()].push_back(asf);
      words_of_beginning = std::max(words_of_beginning, its.size());
    } else if (has_words_of(words, its)) {
      others[its.size()].push_back(asf);
    }
  }
  // What has more of the name than its beginning does may be meant as well.
  std::vector<fs::path> best;
  if (!beginnings.empty()) best = beginnings.rbegin()->second;
  if (best_fit(others) > words_of_beginning)
    std::ranges::copy(others.rbegin()->second, std::back_inserter(best));
  if (best.empty()) return std::nullopt;
  std::ranges::sort(best);
  if (best.size() > 1) reject(amc, "several ASF skeletons fit its name: " + listed(best));
  return best.front();
}

fs::path find_asf(const fs::path& amc) {
  const fs::path folder = amc.parent_path().empty() ? fs::path(".") : amc.parent_path();
  std::vector<fs::path> skeletons;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (is_skeleton_file(path) && !is_resource_fork(path)) skeletons.push_back(path);
  }
  if (const auto named = choose_asf(amc, skeletons)) return *named;
  if (skeletons.size() == 1) return skeletons.front();
  std::ranges::sort(skeletons);
  reject(amc, skeletons.empty()
                  ? "there is no ASF skeleton beside it"
                  : "none of the ASF skeletons beside it has its name: " + listed(skeletons));
}

fs::path asf_of(const fs::path& amc, const ReadOptions& options) {
  if (options.asf.empty()) return find_asf(amc);
  if (options.asf.size() == 1) return options.asf.front();
  if (const auto named = choose_asf(amc, options.asf)) return *named;
  throw Error(ErrorCode::rejected_input,
              "none of the skeletons given has its name: " + listed(options.asf), {amc.string()},
              "name its own with another --asf");
}

Skeleton read_asf_file(const fs::path& path) {
  Skeleton skeleton = read_asf(read_whole_file(path), path.string());
  skeleton.asf_name = path.stem().string();
  return skeleton;
}

}  // namespace reprise

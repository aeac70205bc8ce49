// Postures of takes in a file: a header, the takes, and a checksum of all before it.
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <string>

#include "formats/whole_file.h"
#include "model/new_file.h"
#include "query/motion_library.h"

namespace reprise {
namespace {

static_assert(std::endian::native == std::endian::little, "caches hold numbers as they are");

constexpr std::string_view magic = "RPRSFEA2";  // ends in the version
constexpr std::size_t checksum_bytes = 8;

std::uint64_t checksum(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

class CacheWriter {
 public:
  template <typename T>
  void values(const T* first, std::size_t count) {
    text_.append(reinterpret_cast<const char*>(first), count * sizeof(T));
  }
  template <typename T>
  void value(const T& value) {
    values(&value, 1);
  }
  std::string finish() {
    value(checksum(text_));
    return std::move(text_);
  }

 private:
  std::string text_;
};

/// Reads until the bytes are at their end; then `good()` is false.
class CacheReader {
 public:
  explicit CacheReader(std::string_view bytes) : rest_(bytes) {}
  bool good() const { return good_; }
  bool at_end() const { return rest_.empty(); }
  template <typename T>
  void values(T* first, std::size_t count) {
    good_ = good_ && count <= rest_.size() / sizeof(T);
    if (!good_) return;
    std::memcpy(first, rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
  }
  template <typename T>
  T value() {
    T value{};
    values(&value, 1);
    return value;
  }
  /// A vector of a number of elements that the bytes have to hold.
  template <typename T>
  void vector(std::vector<T>& target, std::size_t count) {
    good_ = good_ && count <= rest_.size() / sizeof(T);
    if (!good_) return;
    target.resize(count);
    values(target.data(), count);
  }

 private:
  std::string_view rest_;
  bool good_ = true;
};

void write_take(CacheWriter& writer, const LibraryTake& take) {
  writer.value(take.key);
  writer.value(take.track.plan.id);
  writer.value(take.track.plan.parents);
  writer.value(take.track.plan.lengths);
  writer.value(take.track.median);
  writer.value(static_cast<std::uint64_t>(take.track.frames()));
  writer.values(take.track.directions.data(), take.track.directions.size());
  writer.values(take.track.speeds.data(), take.track.speeds.size());
}

/// False where this is no take.
bool read_take(CacheReader& reader, LibraryTake& take) {
  take.key = reader.value<Digest>();
  BodyPlan& plan = take.track.plan;
  plan.id = reader.value<std::uint64_t>();
  reader.values(plan.parents.data(), plan.parents.size());
  reader.values(plan.lengths.data(), plan.lengths.size());
  reader.values(take.track.median.data(), take.track.median.size());
  const auto frames = reader.value<std::uint64_t>();
  if (!reader.good() || frames == 0 || frames > std::uint64_t{1} << 40) return false;
  reader.vector(take.track.directions, frames * plan_bones * 3);
  reader.vector(take.track.speeds, frames * root_speeds);
  for (int b = 0; b < plan_bones; ++b) {
    const auto at = static_cast<std::size_t>(b);
    const bool in_order = plan.parents[at] >= -1 && plan.parents[at] < std::max(b, 1);
    if (!in_order || !(plan.lengths[at] >= 0 && plan.lengths[at] < 1e9f)) return false;
  }
  return reader.good();
}

/// The whole file if it is a whole cache, else nothing.
std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (text.size() < magic.size() + sizeof(Digest) + 8 + checksum_bytes ||
      !text.starts_with(magic)) {
    return {};
  }
  const std::string_view checked(text.data(), text.size() - checksum_bytes);
  std::uint64_t stored = 0;
  std::memcpy(&stored, checked.data() + checked.size(), checksum_bytes);
  if (checksum(checked) != stored) return {};
  text.resize(checked.size());
  return text;
}

}  // namespace

std::filesystem::path search_cache_path(const std::filesystem::path& archive) {
  std::filesystem::path path = archive;
  path += ".features";
  return path;
}

std::optional<Digest> content_of_cache(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(magic.size() + sizeof(Digest), '\0');
  if (!stream.read(start.data(), static_cast<std::streamsize>(start.size())) ||
      !start.starts_with(magic)) {
    return std::nullopt;
  }
  Digest content{};
  std::memcpy(content.data(), start.data() + magic.size(), content.size());
  return content;
}

std::vector<LibraryTake> read_feature_cache(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  if (text.empty()) return {};
  CacheReader reader(std::string_view(text).substr(magic.size() + sizeof(Digest)));
  std::vector<LibraryTake> takes;
  for (auto count = reader.value<std::uint64_t>(); count > 0; --count) {
    if (!read_take(reader, takes.emplace_back())) return {};
  }
  if (!reader.at_end()) return {};
  std::ranges::sort(takes, {}, &LibraryTake::key);
  return takes;
}

void write_feature_cache(const std::filesystem::path& file, const Digest& content,
                         const std::vector<LibraryTake>& takes) {
  CacheWriter writer;
  writer.values(magic.data(), magic.size());
  writer.value(content);
  writer.value(static_cast<std::uint64_t>(takes.size()));
  for (const LibraryTake& take : takes) write_take(writer, take);
  remove_dead_new_files(file.parent_path(), file.filename().string());
  write_whole_file(file, writer.finish(), "the search cache cannot be written");
}

}  // namespace reprise

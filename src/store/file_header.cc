#include "store/file_header.h"

#include <algorithm>
#include <string_view>

namespace reprise {
namespace {

// "Database File Format" of SQLite's documentation, section 1.3.
constexpr std::size_t page_size_at = 16, write_version_at = 18, read_version_at = 19,
                      counter_at = 24, pages_at = 28, version_at = 60, application_at = 68,
                      unused_at = 72;
constexpr std::uint8_t version_of_wal = 2;

constexpr std::size_t archive_at = unused_at;
constexpr std::size_t state_at = archive_at + sizeof(FileIdentity::archive);

}  // namespace

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : bytes.subspan(at, 4)) value = value << 8 | byte;
  return value;
}

FileHeader FileHeader::read(std::span<const std::uint8_t> start) {
  constexpr std::string_view magic("SQLite format 3\0", 16);
  FileHeader header;
  header.is_database = std::ranges::equal(
      start.first(magic.size()), magic, {}, [](std::uint8_t b) { return b; },
      [](char c) { return static_cast<std::uint8_t>(c); });
  header.page_size = std::int64_t{start[page_size_at]} << 8 | start[page_size_at + 1];
  if (header.page_size == 1) header.page_size = 65536;
  header.write_ahead =
      start[write_version_at] == version_of_wal || start[read_version_at] == version_of_wal;
  header.counter = number_at(start, counter_at);
  header.pages = number_at(start, pages_at);
  header.version = static_cast<std::int32_t>(number_at(start, version_at));
  header.application = static_cast<std::int32_t>(number_at(start, application_at));
  std::ranges::copy(start.subspan(archive_at, header.identity.archive.size()),
                    header.identity.archive.begin());
  header.identity.state = number_at(start, state_at);
  return header;
}

void write_identity(const FileIdentity& identity, std::span<std::uint8_t> start) {
  std::ranges::copy(identity.archive, start.begin() + archive_at);
  for (std::size_t b = 0; b < 4; ++b) {
    start[state_at + b] = static_cast<std::uint8_t>(identity.state >> (24 - 8 * b));
  }
}

}  // namespace reprise

// The first bytes of an archive file: SQLite's header, and what says which file it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reprise {

/// Which file an archive is, and in which state: a journal that was left beside it belongs to it
/// only if it fits both. They stand in bytes of the header that SQLite keeps for what it may need
/// one day, and leaves as they are.
struct FileIdentity {
  std::array<std::uint8_t, 16> archive{};  ///< random, given when the file is made; stays
  std::uint32_t state = 0;                 ///< nonce of the journal under which it was last changed

  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

struct FileHeader {
  static constexpr std::size_t bytes = 100;  ///< of SQLite's header

  bool is_database = false;    ///< begins with SQLite's magic
  std::int64_t page_size = 0;  ///< bytes
  bool write_ahead = false;    ///< another program has put it into WAL mode
  std::uint32_t counter = 0;   ///< one more with each change
  std::uint32_t pages = 0;
  std::int32_t version = 0;      ///< user_version
  std::int32_t application = 0;  ///< application_id
  FileIdentity identity;

  /// At least `bytes` bytes.
  static FileHeader read(std::span<const std::uint8_t> start);
};

/// Puts the identity into the first page.
void write_identity(const FileIdentity& identity, std::span<std::uint8_t> start);

/// A number of SQLite's files, high byte first.
std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t at);

}  // namespace reprise

// A layer under SQLite that keeps a checksum at the end of every page, since SQLite itself has
// none, and knows whose a journal is.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <span>

namespace reprise {

/// Bytes at the end of each page that SQLite leaves to us.
constexpr int page_checksum_bytes = 8;

/// What SQLite's calls return where the journal beside an archive is not its own (journal_check.h).
/// Nothing was written then.
constexpr int foreign_journal = SQLITE_IOERR | (200 << 8);

/// Registers the layer (once) and returns its name for sqlite3_open_v2. A page whose checksum is
/// wrong is an I/O error (SQLITE_IOERR_DATA) when it is read. The first page of a file that is
/// written names the file and its state (file_header.h).
const char* page_checksum_vfs();

/// The checksum of page `number` (from 1): XXH3-64 of all its bytes but the last eight, seeded with
/// the number.
std::uint64_t page_checksum(std::span<const std::uint8_t> page, std::uint64_t number);

/// True if the last eight bytes of a page (low byte first) are its checksum.
bool page_is_whole(std::span<const std::uint8_t> page, std::uint64_t number);

}  // namespace reprise

#include "store/journal_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "store/file_header.h"

namespace reprise {
namespace {

constexpr std::array<std::uint8_t, 8> magic = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
/// A record is the number of a page, the page, and a checksum.
constexpr std::int64_t around_page = 8;
constexpr std::int64_t least_page = 512, largest_page = 65536;
/// Bytes this far apart, from the end of a page, are summed up in its checksum.
constexpr std::int64_t checksum_stride = 200;

/// A file that is read piece by piece; after an error nothing more.
class Source {
 public:
  explicit Source(sqlite3_file* file) : file_(file) {
    result_ = file->pMethods->xFileSize(file, &size_);
  }
  int result() const { return result_; }
  std::int64_t size() const { return size_; }
  /// False where the file ends before, or cannot be read.
  bool read(std::span<std::uint8_t> to, std::int64_t at) {
    if (result_ != SQLITE_OK || at + static_cast<std::int64_t>(to.size()) > size_) return false;
    result_ = file_->pMethods->xRead(file_, to.data(), static_cast<int>(to.size()), at);
    return result_ == SQLITE_OK;
  }

 private:
  sqlite3_file* file_;
  sqlite3_int64 size_ = 0;
  int result_ = SQLITE_OK;
};

struct JournalHeader {
  std::int64_t records = 0;
  std::uint32_t nonce = 0;
  std::int64_t pages = 0;  ///< of the file, before the change
  std::int64_t sector = 0, page_size = 0;
};

bool is_size(std::int64_t size, std::int64_t least) {
  return size >= least && size <= largest_page && (size & (size - 1)) == 0;
}

std::optional<JournalHeader> header_at(Source& journal, std::int64_t at) {
  std::array<std::uint8_t, journal_start_bytes> bytes{};
  if (!journal.read(bytes, at)) return std::nullopt;
  if (!std::equal(magic.begin(), magic.end(), bytes.begin())) return std::nullopt;
  return JournalHeader{number_at(bytes, 8), number_at(bytes, journal_nonce_at),
                       number_at(bytes, 16), number_at(bytes, 20), number_at(bytes, 24)};
}

/// SQLite ends a journal that is of several databases with the name of another file and the magic.
bool names_another_file(Source& journal) {
  std::array<std::uint8_t, magic.size()> end{};
  return journal.read(end, journal.size() - static_cast<std::int64_t>(end.size())) && end == magic;
}

/// The records of a journal, one after the other; large pages need no more memory than small ones.
class Records {
 public:
  Records(Source& journal, const JournalHeader& first) : journal_(journal), first_(first) {}

  /// False where a record is not what was written.
  bool read_segment(const JournalHeader& header, std::int64_t at) {
    const std::int64_t record = first_.page_size + around_page;
    if (header.records > (journal_.size() - at) / record) return false;
    for (std::int64_t r = 0; r < header.records; ++r, at += record) {
      if (!read_record(header.nonce, at)) return false;
    }
    return true;
  }
  const std::optional<FileHeader>& first_page() const { return first_page_; }

 private:
  bool read_record(std::uint32_t nonce, std::int64_t at) {
    std::array<std::uint8_t, 4> number{}, stored{};
    const auto page = std::span(page_).first(static_cast<std::size_t>(first_.page_size));
    if (!journal_.read(number, at) || !journal_.read(page, at + 4) ||
        !journal_.read(stored, at + 4 + first_.page_size)) {
      return false;
    }
    std::uint32_t sum = nonce;
    for (std::int64_t i = first_.page_size - checksum_stride; i > 0; i -= checksum_stride) {
      sum += page[static_cast<std::size_t>(i)];
    }
    if (sum != number_at(stored, 0) || number_at(number, 0) == 0) return false;
    // SQLite takes the first record of a page.
    if (number_at(number, 0) == 1 && !first_page_) first_page_ = FileHeader::read(page);
    return true;
  }

  Source& journal_;
  const JournalHeader& first_;
  std::optional<FileHeader> first_page_;
  std::array<std::uint8_t, largest_page> page_{};
};

bool is_of_state(const FileHeader& before, const FileHeader& now, std::uint32_t nonce) {
  const bool untouched =
      now.counter == before.counter && now.identity.state == before.identity.state;
  const bool changed = now.counter == before.counter + 1 && now.identity.state == nonce;
  return before.is_database && before.application == now.application &&
         before.identity.archive == now.identity.archive && (untouched || changed);
}

bool fits_file(Source& archive, Source& journal) {
  // It gets its magic when it is synced: before that nothing was done, and SQLite leaves it alone.
  std::array<std::uint8_t, 1> begun{};
  if (!journal.read(begun, 0) || begun[0] == 0) return journal.result() == SQLITE_OK;
  const std::optional<JournalHeader> first = header_at(journal, 0);
  std::array<std::uint8_t, FileHeader::bytes> start{};
  if (!first || names_another_file(journal) || !archive.read(start, 0)) return false;
  const FileHeader now = FileHeader::read(start);
  if (!is_size(first->sector, 32) || !is_size(first->page_size, least_page) ||
      first->page_size != now.page_size) {
    return false;
  }
  Records records(journal, *first);
  std::int64_t count = 0;
  for (std::int64_t at = 0;;) {
    const std::optional<JournalHeader> header = header_at(journal, at);
    if (!header) break;
    at += first->sector;
    if (!records.read_segment(*header, at)) return false;
    count += header->records;
    at += header->records * (first->page_size + around_page);
    at = (at + first->sector - 1) / first->sector * first->sector;
  }
  const std::int64_t size_then = first->pages * first->page_size;
  if (count == 0) return archive.size() == size_then;
  return records.first_page() && is_of_state(*records.first_page(), now, first->nonce) &&
         archive.size() >= size_then;
}

}  // namespace

int check_journal(sqlite3_file* archive_file, sqlite3_file* journal_file, bool& fits) {
  Source archive(archive_file), journal(journal_file);
  fits = false;
  if (archive.result() == SQLITE_OK && journal.result() == SQLITE_OK) {
    fits = fits_file(archive, journal);
  }
  return archive.result() != SQLITE_OK ? archive.result() : journal.result();
}

}  // namespace reprise

#include "store/page_checksum_vfs.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <new>

#include "reprise/error.h"
#include "store/file_header.h"
#include "store/journal_check.h"

namespace reprise {
namespace {

constexpr int least_page = 512;
constexpr const char* vfs_name = "reprise-page-checksum";

/// A file of ours; the real one lies behind it in the same allocation.
struct CheckedFile {
  sqlite3_file base;
  bool is_archive;
  std::uint32_t nonce;   ///< of an archive: that of the journal of the change at hand
  CheckedFile* archive;  ///< of a journal: its archive
  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

CheckedFile* checked(sqlite3_file* file) { return reinterpret_cast<CheckedFile*>(file); }
sqlite3_file* real(sqlite3_file* file) { return checked(file)->real(); }
sqlite3_vfs* real(sqlite3_vfs* vfs) { return static_cast<sqlite3_vfs*>(vfs->pAppData); }

/// SQLite reads and writes whole pages, but for a look at the file's header.
bool is_page(sqlite3_file* file, int size, sqlite3_int64 offset) {
  return checked(file)->is_archive && size >= least_page && (size & (size - 1)) == 0 &&
         offset % size == 0;
}

std::uint64_t number_of(int size, sqlite3_int64 offset) {
  return static_cast<std::uint64_t>(offset / size) + 1;
}

int close_file(sqlite3_file* file) { return real(file)->pMethods->xClose(real(file)); }

int read_file(sqlite3_file* file, void* data, int size, sqlite3_int64 offset) {
  const int result = real(file)->pMethods->xRead(real(file), data, size, offset);
  if (result != SQLITE_OK || !is_page(file, size, offset)) return result;
  const std::span<const std::uint8_t> page(static_cast<const std::uint8_t*>(data),
                                           static_cast<std::size_t>(size));
  return page_is_whole(page, number_of(size, offset)) ? SQLITE_OK : SQLITE_IOERR_DATA;
}

/// SQLite tells a full disk from other errors, but takes a limit on the size of files, or on what a
/// user may have, for one of those.
int with_limits_told(sqlite3_file* file, int result) {
  if ((result & 0xff) != SQLITE_IOERR) return result;
  int number = 0;
  real(file)->pMethods->xFileControl(real(file), SQLITE_FCNTL_LAST_ERRNO, &number);
  if (number == ENOMEM) return SQLITE_IOERR_NOMEM;
  return number != EAGAIN && code_of_errno(number) == ErrorCode::limit ? SQLITE_FULL : result;
}

/// A page that changes the file names the journal that the change can be taken back by. What is
/// played back from a journal is of an earlier state, and says so itself.
int name_state(CheckedFile& file, std::span<std::uint8_t> page) {
  std::array<std::uint8_t, FileHeader::bytes> start{};
  const int result =
      file.real()->pMethods->xRead(file.real(), start.data(), static_cast<int>(start.size()), 0);
  // Of a file that is new, there is less: the rest are zeros.
  if (result != SQLITE_OK && result != SQLITE_IOERR_SHORT_READ) return result;
  const FileHeader now = FileHeader::read(start);
  if (FileHeader::read(page).counter != now.counter + 1) return SQLITE_OK;
  FileIdentity identity{now.identity.archive, file.nonce};
  if (!now.is_database) {
    sqlite3_randomness(static_cast<int>(identity.archive.size()), identity.archive.data());
  }
  write_identity(identity, page);
  return SQLITE_OK;
}

int write_file(sqlite3_file* file, const void* data, int size, sqlite3_int64 offset) {
  if (CheckedFile* archive = checked(file)->archive; archive != nullptr) {
    if (offset == 0 && size >= journal_start_bytes) {
      archive->nonce =
          number_at({static_cast<const std::uint8_t*>(data), static_cast<std::size_t>(size)},
                    journal_nonce_at);
    }
  } else if (is_page(file, size, offset)) {
    // In SQLite's own copy, as its checksum VFS does it: what a later journal holds of this page is
    // then what the file has.
    const std::span page(static_cast<std::uint8_t*>(const_cast<void*>(data)),
                         static_cast<std::size_t>(size));
    if (offset == 0) {
      const int result = name_state(*checked(file), page);
      if (result != SQLITE_OK) return result;
    }
    const std::uint64_t checksum = page_checksum(page, number_of(size, offset));
    for (std::size_t b = 0; b < page_checksum_bytes; ++b) {
      page[page.size() - page_checksum_bytes + b] = static_cast<std::uint8_t>(checksum >> (8 * b));
    }
  }
  return with_limits_told(file, real(file)->pMethods->xWrite(real(file), data, size, offset));
}

int truncate_file(sqlite3_file* f, sqlite3_int64 size) {
  return with_limits_told(f, real(f)->pMethods->xTruncate(real(f), size));
}
int sync_file(sqlite3_file* f, int flags) {
  return with_limits_told(f, real(f)->pMethods->xSync(real(f), flags));
}
int size_of_file(sqlite3_file* f, sqlite3_int64* size) {
  return real(f)->pMethods->xFileSize(real(f), size);
}
int lock_file(sqlite3_file* f, int level) { return real(f)->pMethods->xLock(real(f), level); }
int unlock_file(sqlite3_file* f, int level) { return real(f)->pMethods->xUnlock(real(f), level); }
int check_lock(sqlite3_file* f, int* held) {
  return real(f)->pMethods->xCheckReservedLock(real(f), held);
}
int control_file(sqlite3_file* f, int op, void* arg) {
  return real(f)->pMethods->xFileControl(real(f), op, arg);
}
int sector_size(sqlite3_file* f) { return real(f)->pMethods->xSectorSize(real(f)); }
int characteristics(sqlite3_file* f) {
  // A torn page would fail its checksum, so nothing is promised that the real file does not. Every
  // change has a journal that is whole once the file is touched, whatever a file system can do.
  return real(f)->pMethods->xDeviceCharacteristics(real(f)) & SQLITE_IOCAP_POWERSAFE_OVERWRITE;
}

const sqlite3_io_methods methods = [] {
  sqlite3_io_methods m{};
  m.iVersion = 1;
  m.xClose = close_file;
  m.xRead = read_file;
  m.xWrite = write_file;
  m.xTruncate = truncate_file;
  m.xSync = sync_file;
  m.xFileSize = size_of_file;
  m.xLock = lock_file;
  m.xUnlock = unlock_file;
  m.xCheckReservedLock = check_lock;
  m.xFileControl = control_file;
  m.xSectorSize = sector_size;
  m.xDeviceCharacteristics = characteristics;
  return m;
}();

/// A journal that is opened and not made was left by a writer that died: SQLite looks at it, and
/// then plays it back.
int check_left_journal(sqlite3_file* file) {
  bool fits = false;
  const int result = check_journal(checked(file)->archive->real(), real(file), fits);
  if (result == SQLITE_OK && fits) return SQLITE_OK;
  real(file)->pMethods->xClose(real(file));
  return result != SQLITE_OK ? result : foreign_journal;
}

/// Why a file cannot be made, as an errno, or 0. SQLite tries in several ways, and the last one's
/// errno says nothing.
int hindrance_of(const char* name) {
  const int descriptor = ::open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  ::close(descriptor);
  return 0;
}

int open_file(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out) {
  file->pMethods = nullptr;
  checked(file)->is_archive = (flags & SQLITE_OPEN_MAIN_DB) != 0;
  checked(file)->nonce = 0;
  checked(file)->archive = nullptr;
  int result = real(vfs)->xOpen(real(vfs), name, real(file), flags, out);
  if (real(file)->pMethods == nullptr) {
    const bool new_journal =
        (flags & SQLITE_OPEN_MAIN_JOURNAL) != 0 && (flags & SQLITE_OPEN_CREATE) != 0;
    const int number = new_journal && result == SQLITE_CANTOPEN ? hindrance_of(name) : 0;
    if (number != 0) errno = number;
    return result;
  }
  if ((flags & SQLITE_OPEN_MAIN_JOURNAL) != 0) {
    checked(file)->archive = checked(sqlite3_database_file_object(name));
    const bool left = result == SQLITE_OK && (flags & SQLITE_OPEN_CREATE) == 0;
    if (left) result = check_left_journal(file);
    if (left && result != SQLITE_OK) return result;
  }
  file->pMethods = &methods;
  return result;
}

int delete_file(sqlite3_vfs* v, const char* name, int sync) {
  return real(v)->xDelete(real(v), name, sync);
}
int access_file(sqlite3_vfs* v, const char* name, int flags, int* out) {
  return real(v)->xAccess(real(v), name, flags, out);
}
int full_name(sqlite3_vfs* v, const char* name, int size, char* out) {
  return real(v)->xFullPathname(real(v), name, size, out);
}
int randomness(sqlite3_vfs* v, int size, char* out) {
  return real(v)->xRandomness(real(v), size, out);
}
int sleep_for(sqlite3_vfs* v, int microseconds) { return real(v)->xSleep(real(v), microseconds); }
int current_time(sqlite3_vfs* v, double* out) { return real(v)->xCurrentTime(real(v), out); }
int last_error(sqlite3_vfs* v, int size, char* out) {
  return real(v)->xGetLastError(real(v), size, out);
}

}  // namespace

std::uint64_t page_checksum(std::span<const std::uint8_t> page, std::uint64_t number) {
  return XXH3_64bits_withSeed(page.data(), page.size() - page_checksum_bytes, number);
}

bool page_is_whole(std::span<const std::uint8_t> page, std::uint64_t number) {
  std::uint64_t stored = 0;
  for (std::size_t b = 0; b < page_checksum_bytes; ++b) {
    stored |= std::uint64_t{page[page.size() - page_checksum_bytes + b]} << (8 * b);
  }
  return stored == page_checksum(page, number);
}

const char* page_checksum_vfs() {
  static std::once_flag once;
  static sqlite3_vfs vfs{};
  std::call_once(once, [] {
    if (sqlite3_initialize() != SQLITE_OK) throw std::bad_alloc();
    sqlite3_vfs* system = sqlite3_vfs_find(nullptr);
    vfs.iVersion = 1;
    vfs.szOsFile = static_cast<int>(sizeof(CheckedFile)) + system->szOsFile;
    vfs.mxPathname = system->mxPathname;
    vfs.zName = vfs_name;
    vfs.pAppData = system;
    vfs.xOpen = open_file;
    vfs.xDelete = delete_file;
    vfs.xAccess = access_file;
    vfs.xFullPathname = full_name;
    vfs.xRandomness = randomness;
    vfs.xSleep = sleep_for;
    vfs.xCurrentTime = current_time;
    vfs.xGetLastError = last_error;
    sqlite3_vfs_register(&vfs, 0);
  });
  return vfs_name;
}

}  // namespace reprise

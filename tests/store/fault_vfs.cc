#include "store/fault_vfs.h"

#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <string_view>

namespace reprise {
namespace {

FaultVfs::Fault fault_to_come;
std::vector<FileStep> all_steps;

/// Notes a step; true where it has to fail.
bool fails(FileStep step) {
  const bool now = static_cast<long>(all_steps.size()) == fault_to_come.step;
  all_steps.push_back(std::move(step));
  if (now && fault_to_come.number == 0) ::_exit(FaultVfs::died);
  if (now) errno = fault_to_come.number;
  return now;
}

struct FaultFile {
  sqlite3_file base;
  bool noted;  ///< one with a name
  char name[200];
  int number;  ///< errno of the last failure, or 0
  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

FaultFile* of(sqlite3_file* file) { return reinterpret_cast<FaultFile*>(file); }
sqlite3_file* real(sqlite3_file* file) { return of(file)->real(); }
sqlite3_vfs* real(sqlite3_vfs* vfs) { return static_cast<sqlite3_vfs*>(vfs->pAppData); }

bool fails(sqlite3_file* file, FileStep::Kind kind) {
  of(file)->number = 0;
  if (!of(file)->noted || !fails({kind, of(file)->name})) return false;
  of(file)->number = errno;
  return true;
}

int close_file(sqlite3_file* f) { return real(f)->pMethods->xClose(real(f)); }
int read_file(sqlite3_file* f, void* data, int size, sqlite3_int64 at) {
  return real(f)->pMethods->xRead(real(f), data, size, at);
}
int write_file(sqlite3_file* f, const void* data, int size, sqlite3_int64 at) {
  // As SQLite's own file system tells it.
  if (fails(f, FileStep::Kind::write))
    return of(f)->number == ENOSPC ? SQLITE_FULL : SQLITE_IOERR_WRITE;
  return real(f)->pMethods->xWrite(real(f), data, size, at);
}
int truncate_file(sqlite3_file* f, sqlite3_int64 size) {
  if (fails(f, FileStep::Kind::truncate)) return SQLITE_IOERR_TRUNCATE;
  return real(f)->pMethods->xTruncate(real(f), size);
}
int sync_file(sqlite3_file* f, int) {
  return fails(f, FileStep::Kind::sync) ? SQLITE_IOERR_FSYNC : SQLITE_OK;
}
int size_of_file(sqlite3_file* f, sqlite3_int64* size) {
  return real(f)->pMethods->xFileSize(real(f), size);
}
int lock_file(sqlite3_file* f, int level) { return real(f)->pMethods->xLock(real(f), level); }
int unlock_file(sqlite3_file* f, int level) { return real(f)->pMethods->xUnlock(real(f), level); }
int check_lock(sqlite3_file* f, int* held) {
  return real(f)->pMethods->xCheckReservedLock(real(f), held);
}
int control_file(sqlite3_file* f, int op, void* argument) {
  if (op == SQLITE_FCNTL_LAST_ERRNO && of(f)->number != 0) {
    *static_cast<int*>(argument) = of(f)->number;
    return SQLITE_OK;
  }
  return real(f)->pMethods->xFileControl(real(f), op, argument);
}
int sector_size(sqlite3_file* f) { return real(f)->pMethods->xSectorSize(real(f)); }
int characteristics(sqlite3_file* f) { return real(f)->pMethods->xDeviceCharacteristics(real(f)); }

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

std::string leaf(const char* path) {
  const std::string_view whole(path == nullptr ? "" : path);
  return std::string(whole.substr(whole.rfind('/') + 1));
}

int open_file(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out) {
  auto* opened = new (file) FaultFile{};
  opened->noted = name != nullptr;
  leaf(name).copy(opened->name, sizeof opened->name - 1);
  if (name != nullptr && (flags & SQLITE_OPEN_CREATE) != 0 &&
      fails({FileStep::Kind::make, opened->name})) {
    return SQLITE_CANTOPEN;
  }
  const int result = real(vfs)->xOpen(real(vfs), name, real(file), flags, out);
  if (real(file)->pMethods != nullptr) file->pMethods = &methods;
  return result;
}

int delete_file(sqlite3_vfs* vfs, const char* name, int sync) {
  if (fails({FileStep::Kind::remove, leaf(name), sync != 0})) return SQLITE_IOERR_DELETE;
  return real(vfs)->xDelete(real(vfs), name, 0);
}

}  // namespace

void FaultVfs::install() {
  static sqlite3_vfs vfs{};
  if (vfs.zName != nullptr) return;
  sqlite3_vfs* system = sqlite3_vfs_find(nullptr);
  vfs = *system;
  vfs.iVersion = 1;
  vfs.szOsFile = static_cast<int>(sizeof(FaultFile)) + system->szOsFile;
  vfs.pNext = nullptr;
  vfs.zName = "reprise-test-faults";
  vfs.pAppData = system;
  vfs.xOpen = open_file;
  vfs.xDelete = delete_file;
  sqlite3_vfs_register(&vfs, 1);
}

void FaultVfs::begin(const Fault& fault) {
  fault_to_come = fault;
  all_steps.clear();
}

const std::vector<FileStep>& FaultVfs::steps() { return all_steps; }

}  // namespace reprise

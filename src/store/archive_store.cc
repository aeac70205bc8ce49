// Opening and closing an archive file.
#include "store/archive_store.h"

#include <cassert>

#include "model/new_file.h"
#include "store/archive_file.h"
#include "store/store_impl.h"

namespace reprise {

namespace fs = std::filesystem;

namespace {

void refuse_folder(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return;
  throw Error(ErrorCode::damaged, "this is a folder, not an archive", {path.string()});
}

}  // namespace

ArchiveStore::ArchiveStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ArchiveStore::~ArchiveStore() = default;
ArchiveStore::ArchiveStore(ArchiveStore&&) noexcept = default;
ArchiveStore& ArchiveStore::operator=(ArchiveStore&&) noexcept = default;

ArchiveStore ArchiveStore::open_for_reading(const fs::path& path) {
  std::error_code error;
  refuse_folder(path);
  const auto size = fs::file_size(path, error);
  if (error) throw Error(ErrorCode::failed, "there is no such archive", {path.string()});
  if (size == 0) {
    throw Error(ErrorCode::damaged, "the archive is an empty file", {path.string()});
  }
  // Beside the file itself, where SQLite has it: `path` may be a link.
  fs::path journal = fs::weakly_canonical(path, error);
  journal += "-journal";
  if (fs::exists(journal, error) && fs::file_size(journal, error) > 0) {
    // Another program's file is its own to mend.
    check_header(Database(path, Database::Mode::read));
    try {
      // A writer that died left this: opening for writing takes back what it had not finished.
      const Database recovery(path, Database::Mode::write);
      Statement(recovery, "SELECT count(*) FROM sqlite_schema").step();
    } catch (const Error& cannot) {
      if (cannot.code() == ErrorCode::damaged) throw;
    }
  }
  auto impl = std::make_unique<Impl>();
  impl->database.emplace(path, Database::Mode::read);
  check_identity(*impl->database);
  return ArchiveStore(std::move(impl));
}

ArchiveStore ArchiveStore::open_for_writing(const fs::path& path, WaitNotice waiting) {
  refuse_folder(path);
  const bool created = create_if_missing(path);
  auto impl = std::make_unique<Impl>();
  impl->lock.emplace(path, created);
  remove_dead_new_files(path.parent_path(), path.filename().string());
  impl->database.emplace(path, Database::Mode::write);
  impl->writing = true;
  impl->waiting = std::move(waiting);
  check_header(*impl->database);
  // Pages are not written before a commit, which alone waits for readers: then the journal is
  // complete, and holds the first page (journal_check.h). EXTRA: a commit is done only when it
  // would not be undone by a loss of power that brings the deleted journal back.
  impl->database->run(
      "PRAGMA journal_mode=DELETE; PRAGMA synchronous=EXTRA; PRAGMA cache_spill=OFF;");
  // A read first: it takes back what a writer that died had not finished.
  Statement(*impl->database, "SELECT count(*) FROM sqlite_schema").step();
  check_identity(*impl->database);
  if (is_longer_than_it_says(*impl->database)) cut_off_rest(*impl->database, impl->waiting);
  return ArchiveStore(std::move(impl));
}

void ArchiveStore::Impl::require_transaction() const {
  assert(writing && in_transaction && "writes belong in a transaction");
}

void ArchiveStore::begin() {
  if (impl_->broken) throw Error(ErrorCode::failed, "an earlier write to the archive failed");
  impl_->database->run("BEGIN IMMEDIATE");
  impl_->in_transaction = true;
}

void ArchiveStore::commit() {
  impl_->require_transaction();
  try {
    impl_->flush();
    impl_->remove_vacated();
    impl_->database->run_alone("COMMIT", impl_->waiting);
  } catch (...) {
    impl_->broken = true;
    roll_back();
    throw;
  }
  impl_->in_transaction = false;
  impl_->links.reset();
  impl_->lock->keep();
}

void ArchiveStore::roll_back() {
  impl_->in_transaction = false;
  impl_->open.reset();
  impl_->links.reset();
  impl_->vacated.clear();
  // A failed write may have rolled back already.
  if (sqlite3_get_autocommit(impl_->database->handle()) == 0) impl_->database->run("ROLLBACK");
}

void ArchiveStore::compact() {
  // Readers end soon; another program that writes may not.
  impl_->database->run("BEGIN IMMEDIATE; ROLLBACK");
  impl_->database->run_alone("VACUUM", impl_->waiting);
  // SQLite says nothing where the file could not be made shorter after that.
  if (is_longer_than_it_says(*impl_->database)) cut_off_rest(*impl_->database, impl_->waiting);
}

ArchiveStore::Snapshot ArchiveStore::snapshot() const {
  if (impl_->in_transaction) return nullptr;
  if (impl_->snapshots == 0) {
    impl_->database->run("BEGIN");
    // The state is that of the first read.
    Statement first(*impl_->database, "SELECT count(*) FROM sqlite_schema");
    try {
      first.step();
    } catch (...) {
      sqlite3_exec(impl_->database->handle(), "ROLLBACK", nullptr, nullptr, nullptr);
      throw;
    }
  }
  ++impl_->snapshots;
  return Snapshot(impl_.get());
}

void ArchiveStore::EndSnapshot::operator()(Impl* impl) const {
  // Nothing was written, and an error of a read may have ended it already.
  if (--impl->snapshots == 0) {
    sqlite3_exec(impl->database->handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

std::int64_t ArchiveStore::state_number() const { return pragma(*impl_->database, "data_version"); }

int ArchiveStore::format_version() const {
  return static_cast<int>(pragma(*impl_->database, "user_version"));
}

}  // namespace reprise

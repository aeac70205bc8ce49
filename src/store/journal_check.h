// Whether a journal that a writer left belongs to the file that it stands beside.
#pragma once

#include <sqlite3.h>

namespace reprise {

/// Where a journal has the nonce that our files name as their state ("The Rollback Journal" of
/// SQLite's documentation), and how much has to be read to know it (bytes).
constexpr int journal_nonce_at = 12, journal_start_bytes = 28;

/// Reads a rollback journal as SQLite would play it back, and holds it against the file. It fits if
/// - it is one, and whole: what it says to hold was synced before the file was touched;
/// - what it holds of the file's first page has the file's identity, and either the file's state
///   and change counter, or those before the very change that this journal is of;
/// - the file is at least as long as it was then.
/// One that holds nothing fits a file that is as long as it says, and one that SQLite would not
/// play back fits any. Journals that name a further file (a "super-journal") are never ours. `fits`
/// is the answer; returns SQLite's code, which is not SQLITE_OK where one of the files cannot be
/// read.
int check_journal(sqlite3_file* archive, sqlite3_file* journal, bool& fits);

}  // namespace reprise

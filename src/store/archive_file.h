// What an archive is as a file: how it begins, what tables it has, and how it comes to be.
#pragma once

#include <filesystem>

#include "store/database.h"

namespace reprise {

/// What the file is, read from its header alone: another format may have another kind of pages.
/// Through SQLite's own descriptor: closing another one would drop the locks of this process.
/// Throws Error: damaged, newer_version.
void check_header(const Database& database);

/// Identity, size and tables of an archive that was opened. Throws Error: damaged, newer_version.
/// A file may be longer than it says where a writer died that was about to cut off pages that are
/// not needed any more: no byte is lost then.
void check_identity(Database& database);

/// Whether there is more of the file than the archive needs: that of check_identity.
bool is_longer_than_it_says(const Database& database);

/// Cuts that off. Waits for readers, as Database::run_alone does. Throws Error: locked,
/// interrupted, failed.
void cut_off_rest(Database& database, const std::function<bool()>& waiting);

/// Puts an archive without takes where no file is, whole from the first moment on: a writer that
/// dies leaves an archive, not a part of one. An empty file is replaced by one in the same way.
/// False if there was a file already. Throws Error: limit, failed, locked.
bool create_if_missing(const std::filesystem::path& path);

/// What `PRAGMA name` says.
std::int64_t pragma(const Database& database, const std::string& name);

}  // namespace reprise

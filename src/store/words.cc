#include "store/words.h"

#include <new>

namespace reprise {
namespace {

/// SQLite hands out this interface through a parameter of a query (its documentation, "Extending
/// FTS5"). Null where it has no FTS5, or `result` is SQLITE_NOMEM.
fts5_api* full_text_interface(sqlite3* database, int& result) {
  fts5_api* found = nullptr;
  sqlite3_stmt* statement = nullptr;
  result = sqlite3_prepare_v2(database, "SELECT fts5(?1)", -1, &statement, nullptr);
  if (result == SQLITE_OK) {
    sqlite3_bind_pointer(statement, 1, static_cast<void*>(&found), "fts5_api_ptr", nullptr);
    sqlite3_step(statement);
    result = sqlite3_finalize(statement);
  }
  return found;
}

int collect(void* words, int, const char* word, int size, int, int) {
  // SQLite, which calls this, knows no exceptions.
  try {
    static_cast<std::set<std::string>*>(words)->emplace(word, static_cast<std::size_t>(size));
  } catch (const std::bad_alloc&) {
    return SQLITE_NOMEM;
  }
  return SQLITE_OK;
}

}  // namespace

WordSplitter::WordSplitter(const Database& database) {
  int result = SQLITE_OK;
  fts5_api* interface = full_text_interface(database.handle(), result);
  void* context = nullptr;
  if (interface != nullptr)
    result = interface->xFindTokenizer(interface, "unicode61", &context, &functions_);
  if (interface != nullptr && result == SQLITE_OK)
    result = functions_.xCreate(context, nullptr, 0, &tokenizer_);
  if ((result & 0xff) == SQLITE_NOMEM) throw std::bad_alloc();
  if (interface == nullptr || result != SQLITE_OK) {
    throw Error(ErrorCode::failed, "this SQLite has no full-text search (FTS5)");
  }
}

WordSplitter::~WordSplitter() { functions_.xDelete(tokenizer_); }

std::set<std::string> WordSplitter::words(std::string_view text) const {
  std::set<std::string> words;
  const int result = functions_.xTokenize(tokenizer_, &words, FTS5_TOKENIZE_DOCUMENT, text.data(),
                                          static_cast<int>(text.size()), collect);
  if (result == SQLITE_NOMEM) throw std::bad_alloc();
  if (result != SQLITE_OK) {
    throw Error(ErrorCode::failed, "SQLite cannot split a text into words");
  }
  return words;
}

}  // namespace reprise

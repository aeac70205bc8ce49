#include "store/words.h"

namespace reprise {
namespace {

/// SQLite hands out this interface through a parameter of a query (its documentation, "Extending
/// FTS5"). Null where it has no FTS5.
fts5_api* full_text_interface(sqlite3* database) {
  fts5_api* found = nullptr;
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database, "SELECT fts5(?1)", -1, &statement, nullptr) == SQLITE_OK) {
    sqlite3_bind_pointer(statement, 1, static_cast<void*>(&found), "fts5_api_ptr", nullptr);
    sqlite3_step(statement);
  }
  sqlite3_finalize(statement);
  return found;
}

int collect(void* words, int, const char* word, int size, int, int) {
  static_cast<std::set<std::string>*>(words)->emplace(word, static_cast<std::size_t>(size));
  return SQLITE_OK;
}

}  // namespace

WordSplitter::WordSplitter(const Database& database) {
  fts5_api* interface = full_text_interface(database.handle());
  void* context = nullptr;
  if (interface == nullptr ||
      interface->xFindTokenizer(interface, "unicode61", &context, &functions_) != SQLITE_OK ||
      functions_.xCreate(context, nullptr, 0, &tokenizer_) != SQLITE_OK) {
    throw Error(ErrorCode::failed, "this SQLite has no full-text search (FTS5)");
  }
}

WordSplitter::~WordSplitter() { functions_.xDelete(tokenizer_); }

std::set<std::string> WordSplitter::words(std::string_view text) const {
  std::set<std::string> words;
  if (functions_.xTokenize(tokenizer_, &words, FTS5_TOKENIZE_DOCUMENT, text.data(),
                           static_cast<int>(text.size()), collect) != SQLITE_OK) {
    throw Error(ErrorCode::failed, "SQLite cannot split a text into words");
  }
  return words;
}

}  // namespace reprise

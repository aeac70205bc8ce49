// The words of a text, as full-text search sees them.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "store/database.h"

namespace reprise {

/// Splits texts as SQLite's FTS5 does by default (tokenizer `unicode61`): what FTS5 finds by its
/// words is found by these.
class WordSplitter {
 public:
  /// Throws Error (failed) where SQLite has no FTS5.
  explicit WordSplitter(const Database& database);
  ~WordSplitter();
  WordSplitter(const WordSplitter&) = delete;
  WordSplitter& operator=(const WordSplitter&) = delete;

  /// In small letters and without accents, each once.
  std::set<std::string> words(std::string_view text) const;

 private:
  fts5_tokenizer functions_{};
  Fts5Tokenizer* tokenizer_ = nullptr;
};

}  // namespace reprise

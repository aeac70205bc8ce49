#include "store/full_text.h"

namespace reprise {
namespace {

/// Text for FTS5 in which every word must be found, whatever signs are in it.
std::string all_words(const std::string& text) {
  std::string query, word;
  for (const char c : text + " ") {
    if (static_cast<unsigned char>(c) > ' ') {
      word += c;
      if (c == '"') word += c;
      continue;
    }
    if (!word.empty()) query += (query.empty() ? "" : " AND ") + ("\"" + word + "\"");
    word.clear();
  }
  return query;
}

}  // namespace

std::vector<TakeInfo> takes_with_words(const Database& database, const std::vector<TakeInfo>& takes,
                                       const std::string& text) {
  Statement(database,
            "CREATE VIRTUAL TABLE temp.words USING fts5(name, subject, description, tags)")
      .run();
  for (std::size_t i = 0; i < takes.size(); ++i) {
    Statement(database,
              "INSERT INTO temp.words(rowid, name, subject, description, tags) VALUES(?,?,?,?,?)")
        .bind(static_cast<std::int64_t>(i))
        .bind(takes[i].name)
        .bind(takes[i].subject)
        .bind(takes[i].description)
        .bind(takes[i].tags)
        .run();
  }
  std::vector<TakeInfo> result;
  {
    Statement found(database, "SELECT rowid FROM temp.words WHERE words MATCH ? ORDER BY rowid");
    found.bind(all_words(text));
    while (found.step()) result.push_back(takes[static_cast<std::size_t>(found.integer())]);
  }
  Statement(database, "DROP TABLE temp.words").run();
  return result;
}

}  // namespace reprise

// What a keeper knows of takes: a table with the columns take, subject, description and tags.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace reprise {

struct TakeMetadata {
  std::string subject;
  std::string description;
  std::string tags;
};

class MetadataTable {
 public:
  MetadataTable() = default;
  /// Reads a CSV file (RFC 4180) with a header line; columns in any order, others are ignored.
  /// Throws Error (failed) with file and line.
  static MetadataTable read(const std::filesystem::path& path);

  /// The row of a take: by its whole name, else by the longest trailing part that has one. Null:
  /// none.
  const TakeMetadata* find(const std::string& take) const;

 private:
  std::map<std::string, TakeMetadata> rows_;
};

}  // namespace reprise

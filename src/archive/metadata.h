// What a keeper knows of takes: a table with the columns take, subject, description, tags, unit_mm
// and fps.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace reprise {

struct TakeMetadata {
  std::string subject;
  std::string description;
  std::string tags;
  std::optional<double> unit_mm;     ///< millimetres in a length unit of a BVH, as --unit-mm
  std::optional<double> frame_rate;  ///< frames a second, as --fps

  friend bool operator==(const TakeMetadata&, const TakeMetadata&) = default;
};

class MetadataTable {
 public:
  MetadataTable() = default;
  /// Reads a CSV file (RFC 4180) with a header line; columns in any order and in any case, others
  /// are ignored. Throws Error (failed) with file and line; also where two rows of a take differ,
  /// or a unit or frame rate is no number that makes sense.
  static MetadataTable read(const std::filesystem::path& path);

  /// The row of a take: by its whole name, else by the longest trailing part that has one. Null:
  /// none.
  const TakeMetadata* find(const std::string& take) const;
  /// The takes of the rows that none of `takes` finds, in order.
  std::vector<std::string> rows_of_none(std::span<const std::string> takes) const;

 private:
  std::map<std::string, TakeMetadata> rows_;
};

}  // namespace reprise

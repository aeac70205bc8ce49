#include "archive/metadata.h"

#include <csv.h>

#include <set>
#include <vector>

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

struct CsvRows {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row;
};

extern "C" void end_of_field(void* field, std::size_t size, void* rows) {
  static_cast<CsvRows*>(rows)->row.emplace_back(static_cast<const char*>(field), size);
}

extern "C" void end_of_row(int, void* rows) {
  auto* all = static_cast<CsvRows*>(rows);
  all->rows.push_back(std::move(all->row));
  all->row.clear();
}

CsvRows parse_csv(const std::string& text, const std::string& file) {
  csv_parser parser;
  if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
  CsvRows rows;
  const std::size_t parsed =
      csv_parse(&parser, text.data(), text.size(), end_of_field, end_of_row, &rows);
  const bool whole =
      parsed == text.size() && csv_fini(&parser, end_of_field, end_of_row, &rows) == 0;
  const std::string why = csv_strerror(csv_error(&parser));
  csv_free(&parser);
  if (!whole) {
    throw Error(ErrorCode::failed, "the table cannot be read: " + why,
                {file, rows.rows.size() + 1});
  }
  return rows;
}

/// As tables from elsewhere write it: " Subject" is the column subject, too.
std::string column_name(const std::string& cell) {
  const std::size_t from = cell.find_first_not_of(' ');
  if (from == std::string::npos) return {};
  std::string name = cell.substr(from, cell.find_last_not_of(' ') - from + 1);
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

int column_of(const std::vector<std::string>& header, const std::string& name) {
  for (std::size_t c = 0; c < header.size(); ++c) {
    if (column_name(header[c]) == name) return static_cast<int>(c);
  }
  return -1;
}

std::string cell(const std::vector<std::string>& row, int column) {
  return column >= 0 && column < static_cast<int>(row.size()) ? row[column] : std::string();
}

}  // namespace

MetadataTable MetadataTable::read(const std::filesystem::path& path) {
  std::string text = read_whole_file(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  const CsvRows csv = parse_csv(text, path.string());
  if (csv.rows.empty() || column_of(csv.rows[0], "take") < 0) {
    throw Error(ErrorCode::failed, "the table has no column 'take'", {path.string(), 1},
                "its first line names the columns: take, subject, description, tags");
  }
  const auto& header = csv.rows[0];
  MetadataTable table;
  for (std::size_t r = 1; r < csv.rows.size(); ++r) {
    const auto& row = csv.rows[r];
    const std::string take = cell(row, column_of(header, "take"));
    TakeMetadata metadata{cell(row, column_of(header, "subject")),
                          cell(row, column_of(header, "description")),
                          cell(row, column_of(header, "tags"))};
    const auto [known, fresh] = table.rows_.emplace(take, metadata);
    if (!fresh && !(known->second == metadata)) {
      throw Error(ErrorCode::failed, "the table says two things of the take '" + take + "'",
                  {path.string(), 0});
    }
  }
  return table;
}

const TakeMetadata* MetadataTable::find(const std::string& take) const {
  for (std::size_t at = 0; at != std::string::npos;) {
    const auto row = rows_.find(take.substr(at));
    if (row != rows_.end()) return &row->second;
    const std::size_t slash = take.find('/', at);
    at = slash == std::string::npos ? slash : slash + 1;
  }
  return nullptr;
}

std::vector<std::string> MetadataTable::rows_of_none(std::span<const std::string> takes) const {
  std::set<const TakeMetadata*> found;
  for (const std::string& take : takes) found.insert(find(take));
  std::vector<std::string> names;
  for (const auto& [name, row] : rows_) {
    if (!found.contains(&row)) names.push_back(name);
  }
  return names;
}

}  // namespace reprise

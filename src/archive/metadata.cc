#include "archive/metadata.h"

#include <csv.h>

#include <exception>
#include <set>
#include <string_view>
#include <vector>

#include "formats/text_lines.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "reprise/query/take_reading.h"

namespace reprise {
namespace {

struct CsvRow {
  std::size_t line = 0;  ///< 1-based, where its first cell ends
  std::vector<std::string> cells;
};

struct CsvRows {
  std::vector<CsvRow> rows;
  CsvRow row;
  std::size_t line = 0;  ///< that is being parsed
  std::exception_ptr failure;

  /// For what the parser, which knows no exceptions, calls.
  template <class Work>
  void keep_failure(const Work& work) {
    try {
      if (!failure) work();
    } catch (...) {
      failure = std::current_exception();
    }
  }
};

extern "C" void end_of_field(void* field, std::size_t size, void* rows) {
  auto* all = static_cast<CsvRows*>(rows);
  all->keep_failure([&] {
    if (all->row.cells.empty()) all->row.line = all->line;
    all->row.cells.emplace_back(static_cast<const char*>(field), size);
  });
}

extern "C" void end_of_row(int, void* rows) {
  auto* all = static_cast<CsvRows*>(rows);
  all->keep_failure([&] {
    all->rows.push_back(std::move(all->row));
    all->row = {};
  });
}

/// Hands the text on line by line, so that each row knows its own. False where it is no CSV.
bool parse_lines(csv_parser& parser, std::string_view text, CsvRows& rows) {
  while (!text.empty()) {
    ++rows.line;
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end == std::string_view::npos ? end : end + 1);
    text.remove_prefix(line.size());
    if (csv_parse(&parser, line.data(), line.size(), end_of_field, end_of_row, &rows) !=
        line.size()) {
      return false;
    }
  }
  return csv_fini(&parser, end_of_field, end_of_row, &rows) == 0;
}

CsvRows parse_csv(const std::string& text, const std::string& file) {
  csv_parser parser;
  if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
  CsvRows rows;
  const bool whole = parse_lines(parser, text, rows);
  const bool no_memory = csv_error(&parser) == CSV_ENOMEM;
  csv_free(&parser);
  if (no_memory) throw std::bad_alloc();
  if (rows.failure) std::rethrow_exception(rows.failure);
  if (!whole) {
    throw Error(ErrorCode::failed,
                "the table cannot be read: up to this line a cell has a quote too many or too few",
                {file, rows.line}, "a cell with quotes in it stands in quotes, with each doubled");
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

/// The number of a cell, from 1/greatest to `greatest`, or none where it is empty.
std::optional<double> number(const std::string& cell, const char* column, double greatest,
                             const SourcePlace& place) {
  const std::size_t from = cell.find_first_not_of(" \t");
  if (from == std::string::npos) return std::nullopt;
  const std::string_view text(cell.data() + from, cell.find_last_not_of(" \t") + 1 - from);
  const std::optional<double> value = to_number(text);
  if (!value || !(*value >= 1 / greatest) || !(*value <= greatest)) {
    throw Error(ErrorCode::failed,
                std::string("the column ") + column + " takes numbers such as 25.4, not '" +
                    std::string(text) + "'",
                place);
  }
  return value;
}

}  // namespace

MetadataTable MetadataTable::read(const std::filesystem::path& path) {
  std::string text = read_whole_file(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  const std::string file = path == "/dev/stdin" ? "stdin" : path.string();
  const CsvRows csv = parse_csv(text, file);
  if (csv.rows.empty() || column_of(csv.rows[0].cells, "take") < 0) {
    throw Error(ErrorCode::failed, "the table has no column 'take'", {file, 1},
                "its first line names the columns: take, subject, description, tags, unit_mm, fps");
  }
  const auto& header = csv.rows[0].cells;
  MetadataTable table;
  for (std::size_t r = 1; r < csv.rows.size(); ++r) {
    const auto& row = csv.rows[r].cells;
    const std::string take = cell(row, column_of(header, "take"));
    TakeMetadata metadata{cell(row, column_of(header, "subject")),
                          cell(row, column_of(header, "description")),
                          cell(row, column_of(header, "tags")),
                          number(cell(row, column_of(header, "unit_mm")), "unit_mm",
                                 ReadingLimits::greatest_unit_mm, {file, csv.rows[r].line}),
                          number(cell(row, column_of(header, "fps")), "fps",
                                 ReadingLimits::greatest_frame_rate, {file, csv.rows[r].line})};
    const auto [known, fresh] = table.rows_.emplace(take, metadata);
    if (!fresh && !(known->second == metadata)) {
      throw Error(ErrorCode::failed, "the table says two things of the take '" + take + "'",
                  {file, csv.rows[r].line});
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

// A whole archive file, changed below SQLite and within its rows, with every checksum and digest
// of what was changed made right again: whoever forges an archive can do as much.
#include "fuzz/archive_questions.h"
#include "fuzz/edited_bytes.h"
#include "fuzz/sample_archive.h"
#include "fuzz/scratch_folder.h"
#include "reprise/error.h"
#include "store/database.h"
#include "store/page_checksum_vfs.h"
#include "store/take_block.h"

using namespace reprise;

namespace {

void edit_block(const std::filesystem::path& path, FuzzInput& input) {
  Database database(path, Database::Mode::write);
  Statement row(database, "SELECT takes, data FROM blocks WHERE id=?");
  const std::int64_t id = 0;
  if (!row.bind(id).step()) return;
  Bytes takes = row.bytes(), data = row.bytes();
  edit(input.choice(4) == 0 ? data : takes, input);
  Statement(database, "UPDATE blocks SET takes=?, digest=?, data=? WHERE id=?")
      .bind(takes)
      .bind(block_digest(id, takes))
      .bind(data)
      .bind(id)
      .run();
}

void edit_file(std::string& bytes, FuzzInput& input) {
  const std::size_t at = input.number(3) % bytes.size();
  const std::vector<std::uint8_t> over = input.bytes(1 + input.choice(8));
  std::copy_n(over.begin(), std::min(over.size(), bytes.size() - at),
              bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

void mend_pages(std::string& bytes, std::size_t page_size) {
  for (std::size_t at = 0; at + page_size <= bytes.size(); at += page_size) {
    const std::span page(reinterpret_cast<std::uint8_t*>(bytes.data() + at), page_size);
    const std::uint64_t checksum = page_checksum(page, at / page_size + 1);
    for (std::size_t b = 0; b < page_checksum_bytes; ++b)
      page[page_size - page_checksum_bytes + b] = static_cast<std::uint8_t>(checksum >> (8 * b));
  }
}

/// Bytes 16 and 17 of a database, high byte first.
std::size_t page_size_of(const std::string& bytes) {
  return std::size_t{static_cast<std::uint8_t>(bytes[16])} << 8 |
         static_cast<std::uint8_t>(bytes[17]);
}

}  // namespace

/// Input: the questions that are asked, edits; of each the kind (rows or file), then what it does.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string good = read_scratch(sample_archive());
  static const std::size_t page_size = page_size_of(good);
  const std::filesystem::path path = scratch_folder() / "forged.rpz";
  FuzzInput input(data, size);
  const auto questions = static_cast<Questions>(input.choice(question_kinds));
  std::string bytes = good;
  try {
    for (int edits = 0; edits < 8 && !input.empty(); ++edits) {
      if (input.choice(2) == 0) {
        write_scratch(path, bytes);
        edit_block(path, input);
        bytes = read_scratch(path);
      } else {
        edit_file(bytes, input);
        mend_pages(bytes, page_size);
      }
    }
    write_scratch(path, bytes);
    ask_archive(path, questions);
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::damaged || error.code() == ErrorCode::newer_version,
           error.what());
  }
  std::filesystem::remove(path.string() + "-journal");
  return 0;
}

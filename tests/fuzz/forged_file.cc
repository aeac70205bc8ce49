#include "fuzz/forged_file.h"

#include <span>

#include "fuzz/edited_bytes.h"
#include "store/database.h"
#include "store/page_checksum_vfs.h"
#include "store/schema.h"
#include "store/take_block.h"

namespace reprise {

void edit_block(const std::filesystem::path& archive, FuzzInput& input) {
  Database database(archive, Database::Mode::write);
  std::vector<std::int64_t> ids;
  {
    Statement rows(database, "SELECT id FROM blocks ORDER BY id");
    while (rows.step()) ids.push_back(rows.integer());
  }
  if (ids.empty()) return;
  const std::int64_t id = ids[input.choice(ids.size())];
  Bytes takes, data;
  {
    Statement row(database, "SELECT takes, data FROM blocks WHERE id=?");
    row.bind(id).step();
    takes = row.bytes();
    data = row.bytes();
  }
  edit(input.choice(4) == 0 ? data : takes, input);
  Statement(database, "UPDATE blocks SET takes=?, digest=?, data=? WHERE id=?")
      .bind(takes)
      .bind(block_digest(id, takes))
      .bind(data)
      .bind(id)
      .run();
}

void edit_file(std::string& bytes, FuzzInput& input) {
  constexpr std::size_t page = page_size, content = page - page_checksum_bytes;
  // Not the checksums, which are made right again.
  const std::size_t place = input.number(3) % (bytes.size() / page * content);
  const std::size_t at = place / content * page + place % content;
  const std::size_t left = content - place % content;
  const std::string before = bytes;
  const std::vector<std::uint8_t> over = input.bytes(1 + input.choice(8));
  std::copy_n(over.begin(), std::min(over.size(), left),
              bytes.begin() + static_cast<std::ptrdiff_t>(at));
  if (bytes == before) bytes[at] = static_cast<char>(bytes[at] ^ 1);
  for (std::size_t first = 0; first + page <= bytes.size(); first += page) {
    const std::span whole(reinterpret_cast<std::uint8_t*>(bytes.data() + first), page);
    const std::uint64_t checksum = page_checksum(whole, first / page + 1);
    for (std::size_t b = 0; b < page_checksum_bytes; ++b)
      whole[content + b] = static_cast<std::uint8_t>(checksum >> (8 * b));
  }
}

}  // namespace reprise

// A whole archive file, changed below SQLite and within its rows, with every checksum and digest
// of what was changed made right again: whoever forges an archive can do as much.
#include "fuzz/archive_questions.h"
#include "fuzz/forged_file.h"
#include "fuzz/sample_archive.h"
#include "fuzz/scratch_folder.h"
#include "reprise/error.h"

using namespace reprise;

/// Input: the questions that are asked, edits; of each the kind (rows or file), then what it does
/// (forged_file.h).
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string good = read_scratch(sample_archive());
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

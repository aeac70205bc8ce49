// The fuzzers' edits: each of them changes what a reader is given. One that changed nothing would
// be a run without a question.
#include <fmt/format.h>

#include "fuzz/edited_bytes.h"
#include "fuzz/forged_file.h"
#include "fuzz/forged_take.h"
#include "store/database.h"
#include "store/sample_store.h"

namespace reprise {
namespace {

class FuzzEdits : public StoreTest {
 protected:
  /// Inputs of every first two bytes, and some that end early.
  template <class Use>
  static void for_each_input(const Use& use) {
    for (int first = 0; first < 256; first += 3) {
      for (int second = 0; second < 16; ++second) {
        Bytes bytes = random_bytes(40, static_cast<unsigned>(first * 16 + second));
        bytes[0] = static_cast<std::uint8_t>(first);
        bytes[1] = static_cast<std::uint8_t>(second);
        bytes.resize(second % 5 == 0 ? 2 + static_cast<std::size_t>(second) : bytes.size());
        use(bytes);
      }
    }
  }

  static FuzzInput input_of(const Bytes& bytes) { return {bytes.data(), bytes.size()}; }
};

std::string text_of(const Forged& forged) {
  const TakeRecord& take = forged.take;
  std::string text = fmt::format(
      "{} {} {} {} {} {} {} | {} {} {} {} {} {} |", take.info.frames, take.info.text_bytes,
      static_cast<int>(take.info.fidelity.tier), take.info.fidelity.limit_mm,
      take.info.worst_turn.joint, take.info.worst_turn.frame, hexadecimal(take.error_quantiles),
      forged.proportions.frame_rate, forged.proportions.millimetres_per_unit,
      static_cast<int>(forged.proportions.up), forged.proportions.asf_name,
      forged.proportions.source_text, hexadecimal(forged.proportions.layout));
  for (const LayerRecord& layer : take.layers) {
    text += fmt::format("{} {} {} {} |", static_cast<int>(layer.kind), layer.limit_mm,
                        layer.limit_deg, hexadecimal(layer.data));
  }
  for (const ClipRecord& clip : forged.clips)
    text += fmt::format("{} {} {} |", clip.frames, clip.group, static_cast<int>(clip.kind));
  return text + hexadecimal(forged.space.data);
}

TEST_F(FuzzEdits, OfBytesChangeThem) {
  for_each_input([](const Bytes& bytes) {
    for (const std::size_t size : {0u, 1u, 30u}) {
      std::string text(size, 'x');
      FuzzInput input = input_of(bytes);
      edit(text, input);
      EXPECT_NE(text, std::string(size, 'x')) << hexadecimal(bytes);
    }
  });
}

TEST_F(FuzzEdits, OfRecordsChangeThem) {
  for_each_input([](const Bytes& bytes) {
    for (const int number : {1, 2}) {  // of two clips, and of one
      Forged forged;
      forged.take = sample_take({1, 1, number}, number);
      forged.proportions.layout = {1, 2, 3};
      forged.proportions.source_text = "a skeleton";
      forged.space.data = {1, 2, 3};
      forged.clips = sample_clips(number);
      forged.clips.back().frames =
          forged.take.info.frames - (number == 1 ? forged.clips[0].frames : 0);
      const std::string before = text_of(forged);
      FuzzInput input = input_of(bytes);
      edit(forged, input);
      mend(forged);
      EXPECT_NE(text_of(forged), before) << hexadecimal(bytes);
    }
  });
}

TEST_F(FuzzEdits, OfBlocksAndPagesChangeTheFile) {
  make_sample(path_, 70);
  const std::string good = read_bytes(path_);
  const auto rows = [&] {
    Database database(path_, Database::Mode::read);
    Statement row(database, "SELECT takes, data FROM blocks ORDER BY id");
    std::string text;
    while (row.step()) {
      text += hexadecimal(row.bytes()) + " ";
      text += hexadecimal(row.bytes()) + "\n";
    }
    return text;
  };
  const std::string before = rows();
  int number = 0;
  for_each_input([&](const Bytes& bytes) {
    std::string file = good;
    FuzzInput of_file = input_of(bytes);
    edit_file(file, of_file);
    EXPECT_NE(file, good);
    if (++number % 20 != 0) return;
    write_bytes(path_, good);
    FuzzInput of_block = input_of(bytes);
    edit_block(path_, of_block);
    EXPECT_NE(rows(), before) << hexadecimal(bytes);
  });
}

}  // namespace
}  // namespace reprise

// The bytes of a block of takes, as a hostile archive may have them.
#include "fuzz/fuzz_input.h"
#include "reprise/error.h"
#include "store/take_block.h"

using namespace reprise;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const TakeBlock block = unpack_block(1, {data, size});
    expect(block.takes.size() <= TakeBlockLimits::takes, "a block has at most 64 takes");
    block.data_size();
    for (const StoredTake& take : block.takes) {
      expect(block.find(block.id_of(take)) == &take, "a take of a block is found in it");
      long frames = 0;
      for (const StoredClip& clip : take.clips) frames += clip.frames;
      expect(take.clips.empty() || frames == take.record.info.frames,
             "the clips of a take cover it");
    }
    // What is read can be written again when a take is added beside it.
    const Bytes again = pack_block(block);
    expect(pack_block(unpack_block(1, again)) == again, "a block that was read comes back");
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::damaged, error.what());
  }
  return 0;
}

// The bytes of a layer, as a hostile archive may have them: coefficients, refinements and texts.
#include "fuzz/fuzz_input.h"
#include "fuzz/sample_archive.h"
#include "query/take_decoder.h"
#include "reprise/error.h"

using namespace reprise;

/// Input: which take, which of its layers, its frames (2 bytes, up to 299; 0: as they are), the
/// layer's bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static OpenArchive archive(sample_archive());
  static const std::vector<TakeRecord> records = sample_records(archive.store);
  FuzzInput input(data, size);
  const TakeRecord& record = records[input.choice(records.size())];
  StoredLayer layer = read_layer(archive, record, input.choice(record.layers.size()));
  if (const std::uint64_t frames = input.number(2) % 300)
    layer.take.frames = static_cast<long>(frames);
  layer.bytes.assign(input.rest().begin(), input.rest().end());
  try {
    const Take take = decode_layer(layer);
    expect(take.frames() == layer.take.frames, "a take has the frames that are stored of it");
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::damaged, error.what());
  }
  return 0;
}

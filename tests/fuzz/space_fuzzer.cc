// The bytes of a space, as a hostile archive may have them, and takes decoded on what comes of
// them.
#include "fuzz/fuzz_input.h"
#include "fuzz/sample_archive.h"
#include "query/stored_forms.h"
#include "query/take_decoder.h"
#include "reprise/error.h"

using namespace reprise;

/// Input: which take's skeleton, whether the space extends that take's, the space's bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static OpenArchive archive(sample_archive());
  static const std::vector<TakeRecord> records = sample_records(archive.store);
  FuzzInput input(data, size);
  const TakeRecord& record = records[input.choice(records.size())];
  const CodedSpace* base = nullptr;
  if (input.choice(2) == 1 && record.space != 0) base = &archive.space(record.space);
  const Skeleton reference = reference_skeleton(archive.store, record.info.skeleton);
  try {
    const CodedSpace space =
        unpack_space(input.rest(), reference, base == nullptr ? nullptr : &base->space);
    for (const LayerRecord& layer : record.layers) {
      if (layer.kind != LayerKind::coefficients) continue;
      decode_layer({record.info, layer.kind, layer.data, archive.proportions(record.proportions),
                    &space, &space.space.known});
    }
  } catch (const Error& error) {
    expect(error.code() == ErrorCode::damaged, error.what());
  }
  return 0;
}

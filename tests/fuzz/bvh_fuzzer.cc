// A BVH text: refused in words, or a take that is the same after it was written and read again.
#include "fuzz/take_checks.h"

using namespace reprise;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    read_bvh_skeleton(text, "fuzz.bvh");
  } catch (const Error& error) {
    expect_refusal(error);
  }
  try {
    const Take take = read_bvh(text, "fuzz.bvh");
    check_skeleton_text(*take.skeleton, read_bvh_skeleton(take.skeleton->source_text, "again.bvh"));
    check_written(take, [&](const std::string& written) { return read_bvh(written, "again.bvh"); });
  } catch (const Error& error) {
    expect_refusal(error);
  }
  return 0;
}

// An ASF and an AMC text: refused in words, or a take that is the same after it was written and
// read again.
#include "fuzz/take_checks.h"

using namespace reprise;

/// Input: the ASF, a zero byte, the AMC.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\0'), text.size());
  try {
    const auto skeleton = std::make_shared<const Skeleton>(read_asf(text.substr(0, end), "f.asf"));
    check_skeleton_text(*skeleton, read_asf(skeleton->source_text, "again.asf"));
    const Take take = read_amc(text.substr(std::min(end + 1, text.size())), "fuzz.amc", skeleton);
    check_written(
        take, [&](const std::string& written) { return read_amc(written, "again.amc", skeleton); });
  } catch (const Error& error) {
    expect_refusal(error);
  }
  return 0;
}

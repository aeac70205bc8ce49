#include "store/compression.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <memory>

#include "reprise/error.h"

namespace reprise {
namespace {

constexpr int thorough_level = 19;
constexpr int quick_level = 1;
/// What a decoder may allocate for its window (bytes, as a power of two).
constexpr int most_window_log = 27;

struct Free {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

[[noreturn]] void throw_damaged(const char* why) {
  throw Error(ErrorCode::damaged,
              std::string("a compressed part of the archive is damaged: ") + why);
}

}  // namespace

Bytes compress(std::span<const std::uint8_t> bytes, bool thorough,
               std::span<const std::uint8_t> prefix) {
  const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel,
                         thorough ? thorough_level : quick_level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_contentSizeFlag, 1);
  if (!prefix.empty()) ZSTD_CCtx_refPrefix(context.get(), prefix.data(), prefix.size());
  Bytes frame(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(context.get(), frame.data(), frame.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size)) throw std::bad_alloc();
  frame.resize(size);
  return frame;
}

Bytes decompress(std::span<const std::uint8_t> frame, std::size_t most,
                 std::span<const std::uint8_t> prefix) {
  const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR)
    throw_damaged("it is no zstd frame");
  if (size > most) throw_damaged("it says to be larger than it can be");
  const std::unique_ptr<ZSTD_DCtx, Free> context(ZSTD_createDCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, most_window_log);
  if (!prefix.empty()) ZSTD_DCtx_refPrefix(context.get(), prefix.data(), prefix.size());
  Bytes bytes(size);
  const std::size_t got =
      ZSTD_decompressDCtx(context.get(), bytes.data(), bytes.size(), frame.data(), frame.size());
  if (ZSTD_getErrorCode(got) == ZSTD_error_memory_allocation) throw std::bad_alloc();
  if (ZSTD_isError(got)) throw_damaged(ZSTD_getErrorName(got));
  if (got != size) throw_damaged("it is shorter than it says");
  return bytes;
}

}  // namespace reprise

#include "exact/plain_frame.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <array>
#include <memory>
#include <new>

#include "exact/damaged_text.h"

namespace reprise {
namespace {

constexpr int level = 19;
constexpr int rough_level = 3;
constexpr int most_window_log = 27;
/// What every frame starts with; it is left out.
constexpr std::array<std::uint8_t, 4> magic = {0x28, 0xb5, 0x2f, 0xfd};

struct Free {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

std::vector<std::uint8_t> compress(ZSTD_CCtx* context, std::string_view text) {
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, 0);
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 0);
  std::vector<std::uint8_t> frame(ZSTD_compressBound(text.size()));
  const std::size_t size =
      ZSTD_compress2(context, frame.data(), frame.size(), text.data(), text.size());
  if (ZSTD_isError(size)) throw std::bad_alloc();
  frame.resize(size);
  frame.erase(frame.begin(), frame.begin() + magic.size());
  return frame;
}

}  // namespace

std::vector<std::uint8_t> compress_plain(std::string_view text) {
  const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  return compress(context.get(), text);
}

std::size_t rough_plain_size(std::string_view text) {
  const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, rough_level);
  // Repeats far apart are found as well as the highest levels find them.
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_enableLongDistanceMatching, 1);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, most_window_log);
  return compress(context.get(), text).size();
}

std::string decompress_plain(std::span<const std::uint8_t> frame, std::size_t most) {
  const std::unique_ptr<ZSTD_DCtx, Free> context(ZSTD_createDCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, most_window_log);
  std::string text;
  std::vector<char> piece(ZSTD_DStreamOutSize());
  ZSTD_inBuffer in{magic.data(), magic.size(), 0};
  for (bool body = false;;) {
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_getErrorCode(left) == ZSTD_error_memory_allocation) throw std::bad_alloc();
    if (ZSTD_isError(left)) throw_damaged_text(ZSTD_getErrorName(left));
    if (out.pos > most - text.size()) throw_damaged_text("it is longer than it says");
    text.append(piece.data(), out.pos);
    if (left == 0) break;
    if (in.pos == in.size && !body) {
      in = {frame.data(), frame.size(), 0};
      body = true;
      continue;
    }
    if (in.pos == in.size && out.pos < out.size) throw_damaged_text("it ends too early");
  }
  if (in.pos != in.size) throw_damaged_text("bytes follow its end");
  return text;
}

}  // namespace reprise

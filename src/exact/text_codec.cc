#include "exact/text_codec.h"

#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>

#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

constexpr int level = 19;

struct Free {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

[[noreturn]] void throw_damaged() {
  throw Error(ErrorCode::damaged, "the text of a take is not as it was written");
}

}  // namespace

std::vector<std::uint8_t> encode_text(std::string_view text, std::string_view known_text) {
  const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  if (!known_text.empty()) {
    ZSTD_CCtx_refPrefix(context.get(), known_text.data(), known_text.size());
  }
  std::vector<std::uint8_t> coded(ZSTD_compressBound(text.size()));
  const std::size_t size =
      ZSTD_compress2(context.get(), coded.data(), coded.size(), text.data(), text.size());
  if (ZSTD_isError(size)) throw std::bad_alloc();
  coded.resize(size);
  return coded;
}

std::string decode_text(std::span<const std::uint8_t> coded, std::string_view known_text) {
  const unsigned long long size = ZSTD_getFrameContentSize(coded.data(), coded.size());
  if (size > InputLimits::file_bytes) throw_damaged();
  const std::unique_ptr<ZSTD_DCtx, Free> context(ZSTD_createDCtx());
  if (!context) throw std::bad_alloc();
  if (!known_text.empty()) {
    ZSTD_DCtx_refPrefix(context.get(), known_text.data(), known_text.size());
  }
  std::string text(size, '\0');
  const std::size_t got =
      ZSTD_decompressDCtx(context.get(), text.data(), text.size(), coded.data(), coded.size());
  if (ZSTD_isError(got) || got != size) throw_damaged();
  return text;
}

}  // namespace reprise

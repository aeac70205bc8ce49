// The layers of a stored take, decoded.
#pragma once

#include <optional>
#include <string>

#include "query/archive_impl.h"

namespace reprise {

/// The coarsest layer that keeps a tier's promise; without a tier the finest. Throws Error (usage)
/// where none does.
std::size_t layer_for(const TakeRecord& take, std::optional<FidelityTier> tier);

/// About what decoding a layer of a take needs at most, in bytes; measured,
/// docs/findings/2026-11-27-long-takes.md.
std::size_t decoding_memory(const Skeleton& skeleton, long frames);
std::size_t decoding_memory(const TakeInfo& take);
/// Few bytes may well be very many frames in which nothing moves: what the `free` bytes of the
/// machine cannot hold is told, not tried. Throws Error (limit).
void check_decoding_memory(const TakeInfo& take, const Skeleton& skeleton, std::size_t free);

/// A layer as it is stored, with what decoding it needs; it refers to what the archive has at hand.
struct StoredLayer {
  TakeInfo take;
  LayerKind kind;
  Bytes bytes;
  const ProportionsRecord& proportions;
  const CodedSpace* space;   ///< of coefficients
  const KnownValues* known;  ///< but of a text
};

/// Reading is for one thread at a time, decoding is not. Both throw Error (damaged), decoding Error
/// (limit) where the machine has not the memory.
StoredLayer read_layer(OpenArchive& archive, const TakeRecord& record, std::size_t layer);
Take decode_layer(const StoredLayer& stored, std::string* text = nullptr);

/// A take as one of its layers has it; where that layer is a text and `text` is given, it is put
/// there, so that nothing is decoded twice. Throws Error (damaged).
Take decode_layer(OpenArchive& archive, const TakeRecord& record, std::size_t layer,
                  std::string* text = nullptr);

/// The source file's bytes. Throws Error (usage) where they are not stored, damaged.
std::string decode_source_text(OpenArchive& archive, const TakeRecord& record);

}  // namespace reprise

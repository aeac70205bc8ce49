// What the motion texts of one kind have in common, learned from some of them and stored once.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exact/linear_prediction.h"
#include "exact/number_format.h"

namespace reprise {

struct TextModel {
  std::string sample;              ///< what is kept beside the numbers of a typical text
  LinearPrediction prediction;     ///< of texts with as many columns
  std::vector<CodedNumber> usual;  ///< what columns that never change mostly have

  bool operator==(const TextModel&) const = default;

  std::vector<std::uint8_t> save() const;
  /// Throws Error (damaged) for anything that `save` did not write; no bytes are an empty model.
  static TextModel load(std::span<const std::uint8_t> bytes);
};

/// A text, and what of its start the decoder has.
struct KnownText {
  std::string_view text;
  std::string_view known;
};

/// Learns from texts with the same columns; those that have others than the first are left aside.
TextModel train_text_model(std::span<const KnownText> texts);

}  // namespace reprise

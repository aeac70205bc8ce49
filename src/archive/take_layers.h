// The layers that a take is stored in: what its fidelity asks for, from the coarsest to the finest.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "archive/space_builder.h"
#include "reprise/archive.h"
#include "store/archive_store.h"

namespace reprise {

struct TakeLayers {
  std::vector<LayerRecord> layers;
  using Part = std::pair<std::string, std::uint64_t>;
  std::vector<Part> spent;       ///< TakeRecord::spent
  PositionErrors errors;         ///< of the finest layer
  std::vector<float> distances;  ///< of the finest layer: frames x joints, mm, in no order
};

/// `fitted` is the take on its space; one that is not kept there is `exact` and has its text alone.
/// `text` the source file, which only `exact` stores.
TakeLayers make_layers(const IngestOptions& options, const CodedSpace& space, const Take& take,
                       const std::string& text, FittedTake fitted);

}  // namespace reprise

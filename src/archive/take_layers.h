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
  std::vector<Part> spent;    ///< TakeRecord::spent
  MotionErrors errors;        ///< of the finest layer
  MotionDistances distances;  ///< of the finest layer, in no order
};

/// A source as it is and as coders see it.
struct CodingSource {
  const Take& take;
  const PreparedTake& prepared;
  const std::string& text;  ///< the source file, which only `exact` stores
};

/// `fitted` is the prepared take on its space; one that is not kept there is `exact` and has its
/// text alone.
TakeLayers make_layers(const IngestOptions& options, const CodedSpace& space,
                       const CodingSource& source, FittedTake fitted);

}  // namespace reprise

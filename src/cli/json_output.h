// The JSON documents' building blocks (docs/cli.md).
#pragma once

#include "cli/console.h"

namespace reprise::cli {

Json to_json(const PositionErrors& errors);        ///< {"mean","rms","p99","max"}
Json to_json(const std::vector<Damage>& damaged);  ///< [{"id","why"}...]
Json to_json(const TakeInfo& take);                ///< an entry of list's "takes"
Json to_json(const ClipInfo& clip);                ///< an entry of list's "clips"
Json to_json(const SkeletonInfo& skeleton);        ///< an entry of list's "skeletons"
Json to_json(const ArchiveStats& stats);           ///< the document of stats
Json to_json(const Comparison& comparison);        ///< the document of compare

/// "bvh" or "amc": the names of --format.
std::string format_name(MotionFormat format);

}  // namespace reprise::cli

// The JSON documents' building blocks (docs/cli.md).
#pragma once

#include "cli/console.h"

namespace reprise::cli {

Json to_json(const PositionErrors& errors);        ///< {"mean","rms","p99","max"}
Json to_json(const RotationErrors& errors);        ///< {"mean","p99","max"}
Json to_json(const std::vector<Damage>& damaged);  ///< [{"id","why"}...]
Json to_json(const TakeInfo& take);                ///< what is known of a take but for its joints
/// An entry of list's "takes", with where errors are largest; `skeleton` is the take's.
Json to_json(const TakeInfo& take, const Skeleton& skeleton);
Json to_json(const ClipInfo& clip);          ///< an entry of list's "clips"
Json to_json(const SkeletonInfo& skeleton);  ///< an entry of list's "skeletons"
Json to_json(const ArchiveStats& stats);     ///< of that of stats, but for where errors are
/// The document of compare.
Json to_json(const Comparison& comparison, const Take& original);
/// Where an error is largest: {"joint","frame","time"}.
Json worst_json(const Skeleton& skeleton, const JointAt& at, double frame_rate);
/// A joint's name; of an end site "end site of" its joint.
std::string joint_label(const Skeleton& skeleton, int joint);

/// "bvh" or "amc": the names of --format.
std::string format_name(MotionFormat format);

}  // namespace reprise::cli

// What a take is, apart from its name: digests of its source and content, and its clips' IDs.
#pragma once

#include <memory>
#include <string>

#include "archive/input_files.h"
#include "archive/metadata.h"
#include "archive/space_training.h"
#include "reprise/formats/motion_file.h"
#include "reprise/query/take_reading.h"
#include "store/archive_store.h"

namespace reprise {

/// What the first look at a file keeps of it.
struct TakeOutline {
  std::string source_digest;  ///< hexadecimal, of the file's bytes and, of an AMC, the ASF's
  std::string subject;        ///< the ASF's name, else the folder's
  std::uint64_t text_bytes = 0;
  Digest content{};
  std::shared_ptr<const Skeleton> skeleton;
  LayoutEvidence evidence;
  ReadingEvidence reading_evidence;
  long frames = 0;
  double frame_rate = 0;
  bool frame_rate_assumed = false;
  TakeLayout layout;
  std::vector<SourceNote> notes;
};

/// A file that is to be stored.
struct FreshTake {
  InputFile file;
  TakeOutline outline;
  TakeMetadata metadata;  ///< what is known of it besides the file; an empty subject is the file's
  bool replaces = false;
};

/// Gives an outline the unit and the up axis that its takes are read with.
void read_as(TakeOutline& outline, const TakeReading& reading);

/// Throws Error (rejected_input).
TakeOutline outline_take(const InputFile& file, const ReadOptions& options);

/// Reads the file for coding. Throws Error (rejected_input) where it is no longer what was
/// outlined.
Take read_again(const FreshTake& fresh, const ReadOptions& options);
/// The same as coders see it.
PreparedTake read_prepared(const FreshTake& fresh, const ReadOptions& options);

/// The same with the motion file's text beside it.
struct SourceTake {
  Take take;
  std::string text;
};
SourceTake read_source(const FreshTake& fresh, const ReadOptions& options);

/// Structure of the skeleton and channel values of frames [first, first + frames).
Digest content_digest(const Skeleton& skeleton, const ChannelMatrix& channels, long first,
                      long frames);

/// The content address of a clip: the first eight bytes of its content digest, high byte first.
std::uint64_t clip_address(const Digest& content);

ClipRecord whole_take_clip(const Digest& content, long frames);

}  // namespace reprise

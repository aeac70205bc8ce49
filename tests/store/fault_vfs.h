// A file system that dies or fails at a chosen step, under the one that archives are read and
// written through.
#pragma once

#include <string>
#include <vector>

namespace reprise {

/// What a file is asked to do that changes something on the disk.
struct FileStep {
  enum class Kind { make, write, truncate, sync, remove };
  Kind kind = Kind::write;
  std::string name;     ///< of the file, without its folder
  bool lasting = true;  ///< of `remove`: the folder is synced, too
};

class FaultVfs {
 public:
  /// What becomes of the step with this number (from 0): the process ends, as if it was killed
  /// before it, or the step is an error of the system with this errno.
  struct Fault {
    long step = -1;
    int number = 0;  ///< 0: the process ends
  };
  /// The exit code of a process that was ended so.
  static constexpr int died = 99;

  /// Makes it the system's, for this process and its children. To be called before the first
  /// archive is opened. Syncs are left out: nothing here cuts the power.
  static void install();
  /// Counts from here on.
  static void begin(const Fault& fault);
  static const std::vector<FileStep>& steps();
};

}  // namespace reprise

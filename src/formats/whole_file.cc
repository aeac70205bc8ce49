#include "formats/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "reprise/error.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

/// 0, or the errno of what could not be done.
int write_and_rename(const fs::path& unfinished, const fs::path& path, std::string_view text) {
  errno = 0;
  std::ofstream stream(unfinished, std::ios::binary | std::ios::trunc);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) return errno != 0 ? errno : EIO;
  std::error_code error;
  fs::rename(unfinished, path, error);
  return error.value();
}

}  // namespace

void write_whole_file(const fs::path& path, std::string_view text, std::string_view what) {
  fs::path unfinished = path;
  unfinished += ".new-" + std::to_string(::getpid());
  const int number = write_and_rename(unfinished, path, text);
  if (number == 0) return;
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  throw Error(code_of_errno(number), std::string(what) + ": " + std::strerror(number),
              {path.string()});
}

}  // namespace reprise

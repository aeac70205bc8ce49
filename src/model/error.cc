#include "reprise/error.h"

#include <cerrno>
#include <utility>

namespace reprise {
namespace {

std::string sentence(const std::string& reason, const SourcePlace& place,
                     const std::string& advice) {
  std::string text;
  if (!place.file.empty()) text += place.file + ":";
  if (place.line > 0) text += std::to_string(place.line) + ":";
  if (!text.empty()) text += " ";
  text += reason;
  if (!advice.empty()) text += "; " + advice;
  return text;
}

}  // namespace

ErrorCode code_of_errno(int number) {
  return number == ENOSPC || number == EDQUOT || number == EFBIG ? ErrorCode::limit
                                                                 : ErrorCode::failed;
}

Error::Error(ErrorCode code, const std::string& reason, SourcePlace place, std::string advice)
    : std::runtime_error(sentence(reason, place, advice)),
      code_(code),
      reason_(reason),
      place_(std::move(place)),
      advice_(std::move(advice)) {}

}  // namespace reprise

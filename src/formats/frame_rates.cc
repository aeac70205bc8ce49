#include "formats/frame_rates.h"

#include <string>

#include "reprise/error.h"
#include "reprise/model/take.h"

namespace reprise {

void check_frame_rate(double rate) {
  if (is_frame_rate(rate)) return;
  throw Error(ErrorCode::usage, "no motion has " + std::to_string(rate) + " frames a second");
}

}  // namespace reprise

// Frame rates that somebody gives for a file.
#pragma once

namespace reprise {

/// Throws Error (usage) where no take may have the rate (is_frame_rate).
void check_frame_rate(double rate);

}  // namespace reprise

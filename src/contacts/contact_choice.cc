#include "contacts/contact_choice.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "contacts/contact_stage.h"
#include "reprise/model/measure.h"

namespace reprise {
namespace {

using Constants = ContactChoiceConstants;

struct Outcome {
  double mean_mm = 0;
  std::optional<FootSkate> skate;
};

Outcome outcome_of(const Skeleton& skeleton, double frame_rate, const PositionMatrix& source,
                   const ChannelMatrix& decoded) {
  const PositionMatrix positions = joint_positions(skeleton, decoded);
  const std::vector<float> distances = joint_distances(source, positions);
  const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
  return {sum / static_cast<double>(std::max<std::size_t>(distances.size(), 1)),
          foot_skate(skeleton, source, positions, frame_rate)};
}

bool slides_less(const std::optional<FootSkate>& skate, double part) {
  return skate && skate->decoded <= part * skate->original;
}

}  // namespace

TakeContacts choose_contacts(const Skeleton& skeleton, const std::vector<Leg>& legs,
                             double frame_rate, const PositionMatrix& source,
                             const ChannelMatrix& decoded) {
  constexpr int in_between = 1;
  constexpr int tightest = (1 << TakeContacts::hold_bits) - 1;
  TakeContacts contacts{find_contacts(legs, source, frame_rate, skeleton.up), 0};
  if (contacts.intervals.empty()) return {};
  const Outcome plain = outcome_of(skeleton, frame_rate, source, decoded);
  if (slides_less(plain.skate, Constants::most_skate_unheld)) return {};
  if (!plain.skate) contacts.hold = in_between;
  for (;; ++contacts.hold) {
    ChannelMatrix channels = decoded;
    apply_contacts(skeleton, legs, frame_rate, contacts, moving_channels(decoded), channels);
    const Outcome held = outcome_of(skeleton, frame_rate, source, channels);
    if (held.mean_mm > Constants::most_error * plain.mean_mm) return {};
    if (!held.skate || contacts.hold == tightest) return contacts;
    if (slides_less(held.skate, Constants::most_skate)) return contacts;
  }
}

}  // namespace reprise

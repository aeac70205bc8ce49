#include "contacts/contact_choice.h"

#include "contacts/contact_stage.h"
#include "reprise/model/measure.h"

namespace reprise {

TakeContacts choose_contacts(const Skeleton& skeleton, const std::vector<Leg>& legs,
                             double frame_rate, const PositionMatrix& source,
                             const ChannelMatrix& decoded) {
  constexpr int in_between = 1;
  constexpr int tightest = (1 << TakeContacts::hold_bits) - 1;
  TakeContacts contacts{find_contacts(legs, source, frame_rate), 0};
  if (contacts.intervals.empty()) return contacts;
  for (; contacts.hold < tightest; ++contacts.hold) {
    ChannelMatrix held = decoded;
    apply_contacts(skeleton, legs, frame_rate, contacts, held);
    const auto skate = foot_skate(skeleton, source, joint_positions(skeleton, held), frame_rate);
    if (!skate) contacts.hold = in_between;
    if (!skate || skate->decoded <= ContactChoiceConstants::most_skate * skate->original) break;
  }
  return contacts;
}

}  // namespace reprise

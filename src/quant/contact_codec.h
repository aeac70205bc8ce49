// Contacts among the bits of a take: for each unit of time and each point, whether its state
// changes.
#pragma once

#include <vector>

#include "contacts/contact_detection.h"
#include "quant/range_coder.h"

namespace reprise {

/// How many points a take has and how its time is divided.
struct ContactShape {
  std::vector<int> points_of_legs;  ///< of each leg
  long frames = 0;
  long unit = 1;  ///< frames

  long units() const { return (frames + unit - 1) / unit; }
};
ContactShape contact_shape(const std::vector<Leg>& legs, long frames, double frame_rate);

/// `contacts` are of the same shape.
void encode_contacts(RangeEncoder& encoder, const ContactShape& shape,
                     const TakeContacts& contacts);

/// Contacts by point and then by time. Whatever the bits say, they are within the shape's frames.
TakeContacts decode_contacts(RangeDecoder& decoder, const ContactShape& shape);

}  // namespace reprise

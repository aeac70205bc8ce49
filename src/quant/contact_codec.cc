#include "quant/contact_codec.h"

#include <algorithm>
#include <array>
#include <bit>

#include "quant/bit_model.h"

namespace reprise {
namespace {

constexpr Probability least_probability = 64;
constexpr int ages = 6;
/// How likely a state is to change, by its age in octaves of units, out of 65536; and how sure that
/// is. Chosen by hand, not fitted.
constexpr std::array<std::uint16_t, ages> first_guess = {1500, 3000, 5000, 5000, 4000, 2500};
constexpr std::uint16_t first_count = 8;

/// Goes through the states of all points in the order of coding.
class ContactWalk {
 public:
  explicit ContactWalk(const ContactShape& shape) {
    for (std::size_t leg = 0; leg < shape.points_of_legs.size(); ++leg) {
      for (int p = 0; p < shape.points_of_legs[leg]; ++p) {
        points_.push_back({leg, p, false, 0});
      }
    }
    for (std::size_t c = 0; c < counters_.size(); ++c) {
      counters_[c] = {first_guess[c % ages], first_count};
    }
  }

  std::size_t point_count() const { return points_.size(); }
  bool stands(std::size_t point) const { return points_[point].stands; }

  /// `code(probability of a change)` codes whether there is one and returns it.
  template <class Code>
  void step(std::size_t point, const Code& code) {
    Point& own = points_[point];
    BitCounter& counter = counters_[context_of(own)];
    const bool changes = code(std::clamp<Probability>(
        counter.probability, least_probability, (1u << probability_bits) - least_probability));
    counter.update(changes);
    own.stands = own.stands != changes;
    own.age = changes ? 0 : own.age + 1;
  }

 private:
  struct Point {
    std::size_t leg;
    int index;
    bool stands;
    long age;
  };

  std::size_t context_of(const Point& own) const {
    bool same_leg = false, other_leg = false;
    for (const Point& point : points_) {
      if (&point == &own) continue;
      (point.leg == own.leg ? same_leg : other_leg) |= point.stands;
    }
    const auto age = static_cast<std::uint64_t>(own.age) + 1;
    const int octave = std::min(static_cast<int>(std::bit_width(age)) - 1, ages - 1);
    const std::size_t flags = (own.index > 0 ? 8u : 0u) + (own.stands ? 4u : 0u) +
                              (same_leg ? 2u : 0u) + (other_leg ? 1u : 0u);
    return flags * ages + static_cast<std::size_t>(octave);
  }

  std::vector<Point> points_;
  std::array<BitCounter, 16 * ages> counters_;
};

}  // namespace

ContactShape contact_shape(const std::vector<Leg>& legs, long frames, double frame_rate) {
  ContactShape shape;
  for (const Leg& leg : legs) shape.points_of_legs.push_back(static_cast<int>(leg.points.size()));
  shape.frames = frames;
  shape.unit = contact_unit(frame_rate);
  return shape;
}

void encode_contacts(RangeEncoder& encoder, const ContactShape& shape,
                     const TakeContacts& contacts) {
  encoder.encode_plain(!contacts.intervals.empty(), 1);
  if (contacts.intervals.empty()) return;
  encoder.encode_plain(static_cast<std::uint32_t>(contacts.hold), TakeContacts::hold_bits);
  ContactWalk walk(shape);
  std::vector<std::vector<bool>> stands(walk.point_count());
  for (std::vector<bool>& of_point : stands) {
    of_point.assign(static_cast<std::size_t>(shape.units()), false);
  }
  for (const ContactInterval& contact : contacts.intervals) {
    for (long f = contact.first; f < contact.end; f += shape.unit) {
      stands[static_cast<std::size_t>(contact.point)][static_cast<std::size_t>(f / shape.unit)] =
          true;
    }
  }
  for (long unit = 0; unit < shape.units(); ++unit) {
    for (std::size_t p = 0; p < walk.point_count(); ++p) {
      const bool changes = stands[p][static_cast<std::size_t>(unit)] != walk.stands(p);
      walk.step(p, [&](Probability change) {
        encoder.encode(changes, change);
        return changes;
      });
    }
  }
}

TakeContacts decode_contacts(RangeDecoder& decoder, const ContactShape& shape) {
  TakeContacts contacts;
  if (decoder.decode_plain(1) == 0) return contacts;
  contacts.hold = static_cast<int>(decoder.decode_plain(TakeContacts::hold_bits));
  ContactWalk walk(shape);
  std::vector<std::vector<ContactInterval>> found(walk.point_count());
  for (long unit = 0; unit < shape.units() && !decoder.ran_out(); ++unit) {
    for (std::size_t p = 0; p < walk.point_count(); ++p) {
      const bool stood = walk.stands(p);
      walk.step(p, [&](Probability change) { return decoder.decode(change); });
      if (!walk.stands(p)) continue;
      const long first = unit * shape.unit;
      if (!stood) found[p].push_back({static_cast<int>(p), first, first});
      found[p].back().end = std::min(first + shape.unit, shape.frames);
    }
  }
  for (const std::vector<ContactInterval>& of_point : found) {
    contacts.intervals.insert(contacts.intervals.end(), of_point.begin(), of_point.end());
  }
  return contacts;
}

}  // namespace reprise

#include "contacts/contact_detection.h"

#include <algorithm>
#include <cmath>

#include "model/foot_contact.h"
#include "model/up_direction.h"

namespace reprise {
namespace {

using Eigen::Index;

double floor_height(const std::vector<Leg>& legs, const PositionMatrix& positions,
                    const UpDirection& up) {
  std::vector<double> heights;
  for (const Leg& leg : legs) {
    for (const std::vector<int>& point : leg.points) {
      for (const int joint : point) {
        for (Index f = 0; f < positions.rows(); ++f) {
          heights.push_back(up.height(positions, f, joint));
        }
      }
    }
  }
  const auto rank = static_cast<std::size_t>(FootContact::floor_percentile / 100.0 *
                                             static_cast<double>(heights.size() - 1));
  std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(rank),
                   heights.end());
  return heights[rank];
}

/// Whether any joint of a point stands, frame by frame. The frames that a speed is measured over
/// stand with it: what is measured there is what should not move.
std::vector<bool> standing_frames(const std::vector<int>& point, const PositionMatrix& positions,
                                  double rate, double floor, const UpDirection& up) {
  const Index frames = positions.rows();
  const Index h = std::max<Index>(1, std::lrint(FootContact::half_window_s * rate));
  std::vector<bool> stands(static_cast<std::size_t>(frames), false);
  for (const int joint : point) {
    for (Index f = h; f + h < frames; ++f) {
      if (up.height(positions, f, joint) >= floor + FootContact::height_mm) continue;
      const double speed =
          up.step(positions, joint, f - h, f + h) * rate / static_cast<double>(2 * h);
      if (speed >= FootContact::speed_mm_s) continue;
      std::fill(stands.begin() + (f - h), stands.begin() + (f + h + 1), true);
    }
  }
  return stands;
}

/// Runs of units most of whose frames stand, gaps that are too short filled.
std::vector<ContactInterval> intervals_of(int point, const std::vector<bool>& stands, long unit) {
  const auto frames = static_cast<long>(stands.size());
  std::vector<ContactInterval> found;
  for (long first = 0; first < frames; first += unit) {
    const long end = std::min(first + unit, frames);
    const long standing = std::count(stands.begin() + first, stands.begin() + end, true);
    if (2 * standing <= end - first) continue;
    const bool joins =
        !found.empty() && first - found.back().end < ContactConstants::shortest_gap_units * unit;
    if (joins) {
      found.back().end = end;
    } else {
      found.push_back({point, first, end});
    }
  }
  std::erase_if(found, [&](const ContactInterval& contact) {
    return contact.end - contact.first < ContactConstants::shortest_units * unit;
  });
  return found;
}

}  // namespace

long contact_unit(double frame_rate) {
  return std::max(1L, std::lrint(std::min(ContactConstants::unit_s * frame_rate, 1e9)));
}

std::vector<ContactInterval> find_contacts(const std::vector<Leg>& legs,
                                           const PositionMatrix& positions, double frame_rate,
                                           UpAxis up_axis) {
  std::vector<ContactInterval> contacts;
  if (legs.empty() || positions.rows() == 0) return contacts;
  const UpDirection up(up_axis);
  const double floor = floor_height(legs, positions, up);
  int index = 0;
  for (const Leg& leg : legs) {
    for (const std::vector<int>& point : leg.points) {
      const auto stands = standing_frames(point, positions, frame_rate, floor, up);
      const auto found = intervals_of(index++, stands, contact_unit(frame_rate));
      contacts.insert(contacts.end(), found.begin(), found.end());
    }
  }
  return contacts;
}

}  // namespace reprise

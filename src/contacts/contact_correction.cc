#include "contacts/contact_correction.h"

#include <algorithm>
#include <cmath>

#include "contacts/contact_stage.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// From offset `from` with slope `from_slope` (a part of the way) to `to`, in a cubic.
Vector3d cubic_between(const Vector3d& from, const Vector3d& from_slope, const Vector3d& to,
                       const Vector3d& to_slope, double part) {
  const double rest = 1 - part;
  return (1 + 2 * part) * rest * rest * from + part * rest * rest * from_slope +
         part * part * (3 - 2 * part) * to - part * part * rest * to_slope;
}

/// How much of a contact is in force: 1 in it, less beside it; 0 where nothing changes.
double fading(double part) { return 1 - part * part * (3 - 2 * part); }

class CorrectionMaker {
 public:
  CorrectionMaker(const JointPath& places, double frame_rate, double half_mean_s)
      : places_(places), rate_(frame_rate), half_mean_s_(half_mean_s), sums_(3, places.cols() + 1) {
    sums_.col(0).setZero();
    for (Index f = 0; f < places.cols(); ++f) sums_.col(f + 1) = sums_.col(f) + places.col(f);
    result_.offset = JointPath::Zero(3, places.cols());
    result_.force.assign(static_cast<std::size_t>(places.cols()), 0.0);
  }

  ContactCorrection run(std::span<const ContactInterval> contacts) {
    for (const ContactInterval& contact : contacts) hold(contact);
    for (std::size_t i = 0; i <= contacts.size() && !contacts.empty(); ++i) {
      const ContactInterval* before = i > 0 ? &contacts[i - 1] : nullptr;
      const ContactInterval* after = i < contacts.size() ? &contacts[i] : nullptr;
      fill_gap(before, after);
    }
    return std::move(result_);
  }

 private:
  /// A state of the correction between two contacts: a value, its slope a frame, and its force.
  struct Knot {
    Index frame = 0;
    Vector3d offset = Vector3d::Zero();
    Vector3d slope = Vector3d::Zero();
    double force = 0;
  };

  Index frames_of(double seconds) const {
    return std::max<Index>(1, std::lrint(std::min(seconds * rate_, 1e9)));
  }

  void hold(const ContactInterval& contact) {
    const Index half = frames_of(half_mean_s_);
    for (Index f = contact.first; f < contact.end; ++f) {
      const Index from = std::max<Index>(contact.first, f - half);
      const Index to = std::min<Index>(contact.end, f + half + 1);
      const Vector3d mean = (sums_.col(to) - sums_.col(from)) / static_cast<double>(to - from);
      result_.offset.col(f) = mean - places_.col(f);
      result_.force[static_cast<std::size_t>(f)] = 1;
    }
  }

  Knot last_of(const ContactInterval& contact) const {
    const Index f = contact.end - 1;
    const Index before = std::max<Index>(contact.first, f - 1);
    return {f, result_.offset.col(f), result_.offset.col(f) - result_.offset.col(before), 1};
  }
  Knot first_of(const ContactInterval& contact) const {
    const Index f = contact.first;
    const Index after = std::min<Index>(contact.end - 1, f + 1);
    return {f, result_.offset.col(f), result_.offset.col(after) - result_.offset.col(f), 1};
  }

  /// One curve between contacts that are near each other, else one from each of them to zero.
  void fill_gap(const ContactInterval* before, const ContactInterval* after) {
    const Index fade = frames_of(ContactStageConstants::fade_s);
    if (before && after && after->first - before->end < 2 * fade) {
      curve(last_of(*before), first_of(*after));
      return;
    }
    if (before) {
      const Knot last = last_of(*before);
      curve(last, Knot{last.frame + fade});
    }
    if (after) {
      const Knot first = first_of(*after);
      curve(Knot{first.frame - fade}, first);
    }
  }

  /// Between two knots, both left out; the curve may begin or end outside the take.
  void curve(const Knot& from, const Knot& to) {
    const auto length = static_cast<double>(to.frame - from.frame);
    const Index end = std::min<Index>(to.frame, places_.cols());
    for (Index f = std::max<Index>(from.frame + 1, 0); f < end; ++f) {
      const double part = static_cast<double>(f - from.frame) / length;
      result_.offset.col(f) =
          cubic_between(from.offset, length * from.slope, to.offset, length * to.slope, part);
      result_.force[static_cast<std::size_t>(f)] =
          from.force * fading(part) + to.force * fading(1 - part);
    }
  }

  const JointPath& places_;
  double rate_, half_mean_s_;
  JointPath sums_;
  ContactCorrection result_;
};

}  // namespace

ContactCorrection correct_path(const JointPath& places, double frame_rate,
                               std::span<const ContactInterval> contacts, double half_mean_s) {
  return CorrectionMaker(places, frame_rate, half_mean_s).run(contacts);
}

}  // namespace reprise

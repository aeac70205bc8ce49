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

Index frames_of(double seconds, double rate) {
  return std::max<Index>(1, std::lrint(std::min(seconds * rate, 1e9)));
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

  void hold(const ContactInterval& contact) {
    const Index half = frames_of(half_mean_s_, rate_);
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
    const Index fade = frames_of(ContactStageConstants::fade_s, rate_);
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

/// Weighted means of the places of a contact: in a window of w frames to both sides the place k
/// frames away weighs w + 1 - |k|.
class WindowMeans {
 public:
  /// Frames first .. end - 1 of `places`.
  WindowMeans(const JointPath& places, Index first, Index end)
      : first_(first),
        origin_(places.col(first)),
        sums_(3, end - first + 1),
        moments_(3, end - first + 1) {
    sums_.col(0).setZero();
    moments_.col(0).setZero();
    for (Index i = 0; i < end - first; ++i) {
      // Not far from zero, so that differences of sums keep their digits.
      const Vector3d place = places.col(first + i) - origin_;
      sums_.col(i + 1) = sums_.col(i) + place;
      moments_.col(i + 1) = moments_.col(i) + static_cast<double>(i) * place;
    }
  }

  /// Around frame f, over the frames from .. to of the window, f among them.
  Vector3d mean(Index f, Index window, Index from, Index to) const {
    const Index at = f - first_, begin = from - first_, end = to - first_ + 1;
    const auto centre = static_cast<double>(at), top = static_cast<double>(window + 1);
    const Vector3d before = (top - centre) * (sums_.col(at + 1) - sums_.col(begin)) +
                            (moments_.col(at + 1) - moments_.col(begin));
    const Vector3d after = (top + centre) * (sums_.col(end) - sums_.col(at + 1)) -
                           (moments_.col(end) - moments_.col(at + 1));
    const auto left = static_cast<double>(at + 1 - begin);
    const auto right = static_cast<double>(end - at - 1);
    const double weight =
        left * top - left * (left - 1) / 2 + right * top - right * (right + 1) / 2;
    return origin_ + (before + after) / weight;
  }

 private:
  Index first_;
  Vector3d origin_;
  JointPath sums_, moments_;
};

}  // namespace

ContactCorrection correct_path(const JointPath& places, double frame_rate,
                               std::span<const ContactInterval> contacts, double half_mean_s) {
  return CorrectionMaker(places, frame_rate, half_mean_s).run(contacts);
}

ContactCorrection steady_path(const JointPath& places, double frame_rate,
                              std::span<const ContactInterval> contacts, double half_window_s) {
  const Index frames = places.cols();
  const Index half = frames_of(half_window_s, frame_rate);
  const Index settle = frames_of(ContactStageConstants::settle_s, frame_rate);
  ContactCorrection result;
  result.offset = JointPath::Zero(3, frames);
  result.force.assign(static_cast<std::size_t>(frames), 0.0);
  for (const ContactInterval& contact : contacts) {
    const WindowMeans means(places, contact.first, contact.end);
    for (Index f = contact.first; f < contact.end; ++f) {
      Index inside = std::max(half, settle);  // frames to the nearer end that is not the take's
      if (contact.first > 0) inside = std::min<Index>(inside, f - contact.first);
      if (contact.end < frames) inside = std::min<Index>(inside, contact.end - 1 - f);
      const Index window = std::min(half, inside);
      const Index from = std::max<Index>(contact.first, f - window);
      const Index to = std::min<Index>(contact.end - 1, f + window);
      result.offset.col(f) = means.mean(f, window, from, to) - places.col(f);
      const double part = std::min(1.0, static_cast<double>(inside) / static_cast<double>(settle));
      result.force[static_cast<std::size_t>(f)] = fading(1 - part);
    }
  }
  return result;
}

}  // namespace reprise

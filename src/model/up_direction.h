// Heights and horizontal distances where any axis may point up.
#pragma once

#include <cmath>

#include "reprise/model/kinematics.h"

namespace reprise {

/// Reads places (PositionMatrix) as heights and as steps over the ground.
class UpDirection {
 public:
  explicit UpDirection(UpAxis up)
      : axis_(static_cast<int>(up) % 3),
        side_(axis_ == 0 ? 1 : 0),
        ahead_(axis_ == 2 ? 1 : 2),
        sign_(static_cast<int>(up) < 3 ? 1 : -1) {}

  /// Of joint `joint` in frame `frame`, mm.
  double height(const PositionMatrix& positions, Eigen::Index frame, Eigen::Index joint) const {
    return sign_ * positions(frame, 3 * joint + axis_);
  }

  /// How far a joint is over the ground from where it was, mm.
  double step(const PositionMatrix& positions, Eigen::Index joint, Eigen::Index from,
              Eigen::Index to) const {
    return std::hypot(positions(to, 3 * joint + side_) - positions(from, 3 * joint + side_),
                      positions(to, 3 * joint + ahead_) - positions(from, 3 * joint + ahead_));
  }

 private:
  int axis_, side_, ahead_;
  double sign_;
};

}  // namespace reprise

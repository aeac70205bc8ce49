// Places of joints against values worked out by hand.
#include "reprise/model/kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

using Eigen::Vector3d;

constexpr double tolerance_mm = 1e-9;

/// A root with one child and its end site; `channels` are the child's, `row` is the only frame.
PositionMatrix arm(const std::string& channels, const std::string& row, double unit_mm = 10.0) {
  const Take take = read_bvh(
      "HIERARCHY\nROOT a\n{\nOFFSET 100 200 300\nCHANNELS 3 Xposition Yposition Zposition\n"
      "JOINT b\n{\nOFFSET 0 2 0\nCHANNELS " +
          channels + "\nEnd Site\n{\nOFFSET 1 0 0\n}\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n" +
          row + "\n",
      "arm.bvh", unit_mm);
  return joint_positions(*take.skeleton, take.channels);
}

Vector3d place(const PositionMatrix& positions, Eigen::Index joint) {
  return positions.row(0).segment<3>(3 * joint).transpose();
}

void expect_near(const Vector3d& a, const Vector3d& b) {
  EXPECT_LT((a - b).norm(), tolerance_mm) << a.transpose() << " and " << b.transpose();
}

TEST(BvhKinematics, PositionChannelsTakeTheOffsetsPlace) {
  const PositionMatrix places = arm("1 Zrotation", "1 2 3 0");
  expect_near(place(places, 0), {10, 20, 30});
  expect_near(place(places, 1), {10, 40, 30});
  expect_near(place(places, 2), {20, 40, 30});
}

TEST(BvhKinematics, OnlyComponentsWithAChannelAreReplaced) {
  const PositionMatrix places = arm("2 Xposition Zrotation", "0 0 0 7 0");
  expect_near(place(places, 1), {70, 20, 0});
}

TEST(BvhKinematics, AJointTurnsWhatIsBelowIt) {
  const PositionMatrix places = arm("1 Zrotation", "0 0 0 90");
  expect_near(place(places, 1), {0, 20, 0});
  expect_near(place(places, 2), {0, 30, 0});
  expect_near(place(arm("1 Yrotation", "0 0 0 90"), 2), {0, 20, -10});
}

// Z Y of 90 degrees each is Rz Ry: x goes to -z and stays there. Y Z is Ry Rz: x goes to y and
// stays there.
TEST(BvhKinematics, TheFirstChannelIsTheOutermostRotation) {
  expect_near(place(arm("3 Zrotation Yrotation Xrotation", "0 0 0 90 90 0"), 2), {0, 20, -10});
  expect_near(place(arm("3 Yrotation Zrotation Xrotation", "0 0 0 90 90 0"), 2), {0, 30, 0});
}

TEST(BvhKinematics, PositionsMayStandBetweenRotations) {
  const PositionMatrix places =
      arm("6 Zrotation Xposition Yrotation Zposition Xrotation Yposition", "0 0 0 90 1 90 3 0 2");
  expect_near(place(places, 1), {10, 20, 30});
  expect_near(place(places, 2), {10, 20, 20});
}

TEST(BvhKinematics, AnAxisMayTurnTwice) {
  expect_near(place(arm("3 Zrotation Yrotation Zrotation", "0 0 0 30 0 60"), 2), {0, 30, 0});
}

TEST(BvhKinematics, UnitsScaleEverything) {
  EXPECT_LT((arm("1 Zrotation", "1 2 3 40", 1000.0) - 100 * arm("1 Zrotation", "1 2 3 40")).norm(),
            1e-6);
}

/// A bone of 3 along x whose axes are turned, and a bone of 1 along y at its end.
PositionMatrix leg(const std::string& axis, const std::string& dof, const std::string& row,
                   const std::string& root = "root 0 0 0 0 0 0", const std::string& angle = "deg") {
  const auto skeleton = std::make_shared<Skeleton>(
      read_asf(":units\nlength 2.54\nangle " + angle +
                   "\n:root\norder TX TY TZ RX RY RZ\naxis XYZ\nposition 0 0 0\norientation 0 0 0\n"
                   ":bonedata\nbegin\nname up\ndirection 1 0 0\nlength 3\naxis " +
                   axis + "\ndof " + dof +
                   "\nend\nbegin\nname low\ndirection 0 1 0\nlength 1\naxis 0 0 0 XYZ\nend\n"
                   ":hierarchy\nbegin\nroot up\nup low\nend\n",
               "leg.asf"));
  const Take take = read_amc(":DEGREES\n1\n" + root + "\nup " + row + "\n", "leg.amc", skeleton);
  return joint_positions(*take.skeleton, take.channels);
}

// A unit is 25.4 / 2.54 = 10 mm.
TEST(AsfKinematics, ABoneTurnsAboutItsNearEnd) {
  const PositionMatrix places = leg("0 0 0 XYZ", "rx ry rz", "0 0 90");
  expect_near(place(places, 0), {0, 0, 0});
  expect_near(place(places, 1), {0, 30, 0});
  expect_near(place(places, 2), {-10, 30, 0});
}

// The bone's x axis, turned by 90 degrees about z, is the world's y axis.
TEST(AsfKinematics, RotationsAreInTheBonesAxes) {
  expect_near(place(leg("0 0 90 XYZ", "rx", "90"), 1), {0, 0, -30});
  expect_near(place(leg("0 0 90 XYZ", "ry", "90"), 1), {30, 0, 0});
}

TEST(AsfKinematics, AxesMayBeInRadians) {
  const std::string quarter = std::to_string(std::numbers::pi / 2);
  const PositionMatrix degrees = leg("0 0 90 XYZ", "rx", "90");
  const PositionMatrix radians =
      leg("0 0 " + quarter + " XYZ", "rx", "90", "root 0 0 0 0 0 0", "rad");
  EXPECT_LT((degrees - radians).norm(), 1e-3);
}

// XYZ: x turns first, so the matrix is Rz Ry Rx; ZYX is Rx Ry Rz. `dof` only orders the values.
TEST(AsfKinematics, TheOrderOfTheAxisTurns) {
  const PositionMatrix one = leg("0 0 0 XYZ", "rx ry rz", "0 90 90");
  expect_near(place(one, 1), {0, 0, -30});
  expect_near(place(leg("0 0 0 XYZ", "rz ry rx", "90 90 0"), 1), {0, 0, -30});
  expect_near(place(leg("0 0 0 ZYX", "rx ry rz", "0 90 90"), 1), {0, 30, 0});
}

TEST(AsfKinematics, TheRootMovesAndTurnsAll) {
  const PositionMatrix places = leg("0 0 0 XYZ", "rx", "0", "root 1 2 3 0 0 90");
  expect_near(place(places, 0), {10, 20, 30});
  expect_near(place(places, 1), {10, 50, 30});
  expect_near(place(places, 2), {0, 50, 30});
}

TEST(AsfKinematics, ABoneMayMoveAndStretch) {
  expect_near(place(leg("0 0 0 XYZ", "tx ty tz", "1 2 3"), 1), {40, 20, 30});
  const PositionMatrix places = leg("0 0 0 XYZ", "l", "2");
  expect_near(place(places, 1), {50, 0, 0});
  expect_near(place(places, 2), {50, 10, 0});
}

TEST(PlaceJoint, SaysWhatEachRotationTurnsAbout) {
  const std::string asf = R"(:units
  angle deg
:root
  order TX TY TZ RX RY RZ
:bonedata
  begin
    id 1
    name bone
    direction 0 0 1
    length 3
    axis 20 30 40 XYZ
    dof rx ry rz
  end
:hierarchy
  begin
    root bone
  end
)";
  const Skeleton skeleton = read_asf(asf, "bone.asf");
  const Joint& bone = skeleton.joints[1];
  std::vector<double> channels = {1, 2, 3, 10, 20, 30, 40, 50, 60};
  const JointFrame parent = place_joint(skeleton, skeleton.joints[0], channels, {});
  std::array<Vector3d, 3> axes;
  const JointFrame frame = place_joint(skeleton, bone, channels, parent, axes);
  constexpr double step = 1e-4;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    EXPECT_NEAR(axes[k].norm(), 1.0, 1e-12);
    double& angle = channels[static_cast<std::size_t>(bone.first_channel + bone.rotation_slots[k])];
    angle += step;
    const JointFrame moved = place_joint(skeleton, bone, channels, parent);
    angle -= step;
    const Vector3d expected =
        (step * std::numbers::pi / 180) * axes[k].cross(frame.position - parent.position);
    EXPECT_LT((moved.position - frame.position - expected).norm(), 1e-3 * expected.norm() + 1e-9);
  }
}

TEST(AxisRotation, IsRightHanded) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d quarter = axis_rotation(axis, std::numbers::pi / 2);
    const Vector3d turned = quarter.col((axis + 1) % 3);
    expect_near(turned, Vector3d::Unit((axis + 2) % 3));
    EXPECT_NEAR(quarter.determinant(), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace reprise

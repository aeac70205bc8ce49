#include "synth/skeleton_text.h"

#include <fmt/format.h>

#include "reprise/formats/motion_file.h"

namespace reprise::synth {
namespace {

using Eigen::Vector3d;

std::string offset_line(const std::string& indent, const Vector3d& offset) {
  const Vector3d value = (offset / bvh_unit).array() + 0.0;
  return fmt::format("{}OFFSET {:.4f} {:.4f} {:.4f}\n", indent, value.x(), value.y(), value.z());
}

void append_joint(std::string& text, const Proportions& body, int joint, int depth) {
  const std::string indent(static_cast<std::size_t>(depth), '\t');
  const std::string inner = indent + '\t';
  text += fmt::format("{}{} {}\n{}{{\n", indent, joint == hips ? "ROOT" : "JOINT",
                      describe(joint).bvh_name, indent);
  text += offset_line(inner, body.offset[static_cast<std::size_t>(joint)]);
  text +=
      inner + fmt::format("CHANNELS {}", joint == hips ? "6 Xposition Yposition Zposition" : "3");
  text +=
      turns_zyx(joint) ? " Zrotation Yrotation Xrotation\n" : " Zrotation Xrotation Yrotation\n";
  bool has_child = false;
  for (int child = joint + 1; child < joint_count; ++child) {
    if (describe(child).parent != joint) continue;
    append_joint(text, body, child, depth + 1);
    has_child = true;
  }
  if (!has_child) {
    text += fmt::format("{}End Site\n{}{{\n", inner, inner);
    text += offset_line(inner + '\t', body.tip[static_cast<std::size_t>(joint)]);
    text += inner + "}\n";
  }
  text += indent + "}\n";
}

/// Bones without degrees of freedom that lead from the root to the joints around it.
struct Link {
  const char* name;
  int joint;
};
constexpr Link links[] = {
    {"lhipjoint", left_up_leg}, {"rhipjoint", right_up_leg}, {"backjoint", spine}};

std::string bone_text(int id, const std::string& name, const Vector3d& bone, double axis_z) {
  const Vector3d direction = bone.normalized().array() + 0.0;
  return fmt::format(
      "  begin\n     id {}\n     name {}\n     direction {:.6f} {:.6f} {:.6f}\n     length {:.6f}\n"
      "     axis 0 0 {:g} XYZ\n",
      id, name, direction.x(), direction.y(), direction.z(), bone.norm() / asf_unit, axis_z);
}

std::string freedom_text(const JointDescription& joint) {
  std::string words, limits;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!joint.free[axis]) continue;
    words += fmt::format(" r{}", "xyz"[axis]);
    limits += fmt::format("{}({:.1f} {:.1f})\n", limits.empty() ? "    limits " : "           ",
                          joint.limits[axis].low, joint.limits[axis].high);
  }
  return "    dof" + words + "\n" + limits;
}

std::string hierarchy_text() {
  std::string text = ":hierarchy\n  begin\n    root";
  for (const Link& link : links) text += fmt::format(" {}", link.name);
  text += '\n';
  for (const Link& link : links)
    text += fmt::format("    {} {}\n", link.name, describe(link.joint).asf_name);
  for (int joint = 1; joint < joint_count; ++joint) {
    std::string children;
    for (int child = joint + 1; child < joint_count; ++child) {
      if (describe(child).parent == joint) children += fmt::format(" {}", describe(child).asf_name);
    }
    if (!children.empty()) text += fmt::format("    {}{}\n", describe(joint).asf_name, children);
  }
  return text + "  end\n";
}

}  // namespace

std::string bvh_hierarchy_text(const Proportions& body) {
  std::string text = "HIERARCHY\n";
  append_joint(text, body, hips, 0);
  return text;
}

std::string asf_text(const Proportions& body, const std::string& name) {
  std::string text = fmt::format(
      ":version 1.10\n:name {}\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n"
      ":documentation\n   A synthetic subject\n"
      ":root\n   order TX TY TZ RX RY RZ\n   axis XYZ\n   position 0 0 0\n   orientation 0 0 0\n"
      ":bonedata\n",
      name);
  int id = 0;
  for (const Link& link : links) {
    text += bone_text(++id, link.name, body.offset[static_cast<std::size_t>(link.joint)], 0) +
            "  end\n";
  }
  for (int joint = 1; joint < joint_count; ++joint) {
    const JointDescription& described = describe(joint);
    text += bone_text(++id, described.asf_name, body.tip[static_cast<std::size_t>(joint)],
                      described.axis_z);
    text += freedom_text(described) + "  end\n";
  }
  return text + hierarchy_text();
}

std::shared_ptr<const Skeleton> make_skeleton(MotionFormat format, const Proportions& body,
                                              const std::string& name) {
  if (format == MotionFormat::bvh) {
    return std::make_shared<const Skeleton>(
        read_bvh_skeleton(bvh_hierarchy_text(body), name + ".bvh", bvh_unit));
  }
  Skeleton skeleton = read_asf(asf_text(body, name), name + ".asf");
  skeleton.asf_name = name;
  return std::make_shared<const Skeleton>(std::move(skeleton));
}

}  // namespace reprise::synth

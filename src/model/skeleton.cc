#include "reprise/model/skeleton.h"

#include <algorithm>
#include <array>

namespace reprise {
namespace {

/// In the order of UpAxis.
constexpr std::array<std::string_view, 6> up_axis_names = {"x", "y", "z", "-x", "-y", "-z"};

void append_number(std::string& bytes, std::int64_t value) {
  for (int byte = 0; byte < 8; ++byte)
    bytes.push_back(static_cast<char>(value >> (8 * byte) & 0xff));
}

void append_text(std::string& bytes, const std::string& text) {
  append_number(bytes, static_cast<std::int64_t>(text.size()));
  bytes += text;
}

}  // namespace

std::string_view up_axis_name(UpAxis up) { return up_axis_names[static_cast<std::size_t>(up)]; }

std::optional<UpAxis> find_up_axis(std::string_view name) {
  std::string lower(name);
  for (char& c : lower) c = c >= 'X' && c <= 'Z' ? static_cast<char>(c - 'X' + 'x') : c;
  const auto found = std::ranges::find(up_axis_names, lower);
  if (found == up_axis_names.end()) return std::nullopt;
  return static_cast<UpAxis>(found - up_axis_names.begin());
}

std::string structure_bytes(const Skeleton& skeleton) {
  std::string bytes;
  append_number(bytes, static_cast<std::int64_t>(skeleton.format));
  append_number(bytes, static_cast<std::int64_t>(skeleton.joints.size()));
  for (const Joint& joint : skeleton.joints) {
    append_text(bytes, joint.name);
    append_number(bytes, joint.parent);
    append_number(bytes, joint.end_site);
    append_number(bytes, static_cast<std::int64_t>(joint.channels.size()));
    for (const Channel channel : joint.channels) append_number(bytes, static_cast<int>(channel));
    append_number(bytes, static_cast<std::int64_t>(joint.rotation_order.size()));
    for (const int axis : joint.rotation_order) append_number(bytes, axis);
  }
  return bytes;
}

bool same_structure(const Skeleton& a, const Skeleton& b) {
  return structure_bytes(a) == structure_bytes(b);
}

}  // namespace reprise

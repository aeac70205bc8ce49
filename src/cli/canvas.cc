#include "cli/canvas.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reprise/error.h"

namespace reprise::cli {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr std::array<Colour, 12> colours{{{200, 30, 30},    // path
                                          {40, 90, 200},    // primary
                                          {60, 170, 80},    // repeated
                                          {190, 190, 190},  // unique
                                          {230, 159, 0},    // behaviours
                                          {86, 180, 233},
                                          {0, 158, 115},
                                          {240, 228, 66},
                                          {0, 114, 178},
                                          {213, 94, 0},
                                          {204, 121, 167},
                                          {130, 90, 60}}};
static_assert(colours.size() == ink::behaviour + ink::behaviours - ink::shades);

}  // namespace

Canvas::Canvas(long width, long height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width * height), ink::white) {}

void Canvas::set(long x, long y, int colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  pixels_[static_cast<std::size_t>(y * width_ + x)] = static_cast<std::uint8_t>(colour);
}

void Canvas::fill(long x0, long x1, long y0, long y1, int colour) {
  for (long y = y0; y < y1; ++y) {
    for (long x = x0; x < x1; ++x) set(x, y, colour);
  }
}

void Canvas::line(CanvasPoint from, CanvasPoint to, double thickness, int colour) {
  const double dx = to.x - from.x, dy = to.y - from.y, squared = dx * dx + dy * dy;
  const double reach = thickness / 2;
  const auto bounds = [reach](double a, double b, long most) {
    const double low = std::floor(std::min(a, b) - reach), high = std::ceil(std::max(a, b) + reach);
    return std::pair(static_cast<long>(std::clamp(low, 0.0, static_cast<double>(most))),
                     static_cast<long>(std::clamp(high, -1.0, static_cast<double>(most - 1))));
  };
  const auto [left, right] = bounds(from.x, to.x, width_);
  const auto [top, bottom] = bounds(from.y, to.y, height_);
  for (long y = top; y <= bottom; ++y) {
    for (long x = left; x <= right; ++x) {
      const double px = static_cast<double>(x) - from.x, py = static_cast<double>(y) - from.y;
      const double at = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0.0;
      if (std::hypot(px - at * dx, py - at * dy) <= reach) set(x, y, colour);
    }
  }
}

std::string Canvas::png() const {
  std::array<std::uint8_t, 3 * (ink::shades + colours.size())> palette{};
  for (std::size_t i = 0; i < palette.size() / 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      palette[3 * i + c] = i < ink::shades ? static_cast<std::uint8_t>(i * 255 / (ink::shades - 1))
                                           : colours[i - ink::shades][c];
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = ink::shades + colours.size();
  png_alloc_size_t size = 0;
  std::string file;
  bool done =
      png_image_write_to_memory(&image, nullptr, &size, 0, pixels_.data(), 0, palette.data()) != 0;
  if (done) {
    file.resize(size);
    done = png_image_write_to_memory(&image, file.data(), &size, 0, pixels_.data(), 0,
                                     palette.data()) != 0;
    file.resize(size);
  }
  if (!done) throw Error(ErrorCode::failed, std::string("no picture: ") + image.message);
  return file;
}

}  // namespace reprise::cli

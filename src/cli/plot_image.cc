#include "cli/plot_image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "reprise/error.h"

namespace reprise::cli {
namespace {

using Colour = std::array<std::uint8_t, 3>;

/// Shades from black to white come first in the palette, then these.
constexpr std::uint8_t shades = 32;
constexpr std::array<Colour, 14> colours{{{200, 30, 30},    // path
                                          {40, 90, 200},    // primary
                                          {60, 170, 80},    // repeated
                                          {190, 190, 190},  // unique
                                          {0, 0, 0},        // tick
                                          {255, 255, 255},  // background
                                          {230, 159, 0},    // behaviours, in turn
                                          {86, 180, 233},
                                          {0, 158, 115},
                                          {240, 228, 66},
                                          {0, 114, 178},
                                          {213, 94, 0},
                                          {204, 121, 167},
                                          {130, 90, 60}}};
constexpr int path = shades, primary = shades + 1, repeated = shades + 2, unique = shades + 3,
              tick = shades + 4, background = shades + 5, behaviour = shades + 6, behaviours = 8;

/// What is this far apart (mm) is white.
constexpr float white_mm = 240;
constexpr double tick_s = 5;
constexpr long strip = 14, gap = 4, margin = 8;

class Canvas {
 public:
  Canvas(long width, long height)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width * height), background) {}

  void set(long x, long y, int colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    pixels_[static_cast<std::size_t>(y * width_ + x)] = static_cast<std::uint8_t>(colour);
  }

  void fill(long x0, long x1, long y0, long y1, int colour) {
    for (long y = y0; y < y1; ++y) {
      for (long x = x0; x < x1; ++x) set(x, y, colour);
    }
  }

  std::string png() const {
    std::array<std::uint8_t, 3 * (shades + colours.size())> palette{};
    for (std::size_t i = 0; i < palette.size() / 3; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        palette[3 * i + c] =
            i < shades ? static_cast<std::uint8_t>(i * 255 / (shades - 1)) : colours[i - shades][c];
      }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width_);
    image.height = static_cast<png_uint_32>(height_);
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = shades + colours.size();
    png_alloc_size_t size = 0;
    std::string file;
    bool done = png_image_write_to_memory(&image, nullptr, &size, 0, pixels_.data(), 0,
                                          palette.data()) != 0;
    if (done) {
      file.resize(size);
      done = png_image_write_to_memory(&image, file.data(), &size, 0, pixels_.data(), 0,
                                       palette.data()) != 0;
      file.resize(size);
    }
    if (!done) throw Error(ErrorCode::failed, std::string("no picture: ") + image.message);
    return file;
  }

 private:
  long width_, height_;
  std::vector<std::uint8_t> pixels_;
};

int shade_of(float distance_mm) {
  const float part = std::min(distance_mm / white_mm, 1.0F);
  return static_cast<int>(std::lround(part * (shades - 1)));
}

int colour_of(ClipKind kind) {
  if (kind == ClipKind::primary) return primary;
  return kind == ClipKind::repeated ? repeated : unique;
}

void draw_plot(Canvas& canvas, const SelfDistance& plot) {
  for (long y = 0; y < plot.samples; ++y) {
    for (long x = 0; x < plot.samples; ++x) {
      canvas.set(margin + x, margin + y,
                 shade_of(plot.distance_mm[static_cast<std::size_t>(y * plot.samples + x)]));
    }
  }
  // A path has its later take across, so that it lies above the diagonal.
  for (const auto& pixels : plot.paths) {
    for (const SelfDistance::Pixel& p : pixels) canvas.set(margin + p.y, margin + p.x, path);
  }
}

}  // namespace

std::string png_of(const SelfDistance& plot) {
  const long behaviours_at = margin + plot.samples + margin, clips_at = behaviours_at + strip + gap;
  Canvas canvas(2 * margin + plot.samples, clips_at + strip + margin);
  draw_plot(canvas, plot);
  const auto column = [&](double seconds) { return margin + std::lround(seconds * plot.rate); };
  for (const SelfDistance::Behaviour& b : plot.behaviours) {
    canvas.fill(column(b.start), column(b.end) - 1, behaviours_at, behaviours_at + strip,
                behaviour + (b.group - 1) % behaviours);
  }
  for (const SelfDistance::Clip& clip : plot.clips) {
    canvas.fill(column(clip.start), column(clip.end) - 1, clips_at, clips_at + strip,
                colour_of(clip.kind));
  }
  for (double seconds = 0; seconds * plot.rate < static_cast<double>(plot.samples);
       seconds += tick_s) {
    canvas.fill(column(seconds), column(seconds) + 1, margin / 2, margin, tick);
    canvas.fill(margin / 2, margin, column(seconds), column(seconds) + 1, tick);
    canvas.fill(column(seconds), column(seconds) + 1, behaviours_at - margin / 2, behaviours_at,
                tick);
  }
  return canvas.png();
}

}  // namespace reprise::cli

#include "cli/plot_image.h"

#include <algorithm>
#include <cmath>

#include "cli/canvas.h"

namespace reprise::cli {
namespace {

/// What is this far apart (mm) is white.
constexpr float white_mm = 240;
constexpr double tick_s = 5;
constexpr long strip = 14, gap = 4, margin = 8;

int shade_of(float distance_mm) {
  const float part = std::min(distance_mm / white_mm, 1.0F);
  return static_cast<int>(std::lround(part * (ink::shades - 1)));
}

int colour_of(ClipKind kind) {
  if (kind == ClipKind::primary) return ink::primary;
  return kind == ClipKind::repeated ? ink::repeated : ink::unique;
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
    for (const SelfDistance::Pixel& p : pixels) canvas.set(margin + p.y, margin + p.x, ink::path);
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
                ink::behaviour + (b.group - 1) % ink::behaviours);
  }
  for (const ClipInfo& clip : plot.clips) {
    canvas.fill(column(clip.start), column(clip.end) - 1, clips_at, clips_at + strip,
                colour_of(clip.kind));
  }
  for (double seconds = 0; seconds * plot.rate < static_cast<double>(plot.samples);
       seconds += tick_s) {
    canvas.fill(column(seconds), column(seconds) + 1, margin / 2, margin, ink::black);
    canvas.fill(margin / 2, margin, column(seconds), column(seconds) + 1, ink::black);
    canvas.fill(column(seconds), column(seconds) + 1, behaviours_at - margin / 2, behaviours_at,
                ink::black);
  }
  return canvas.png();
}

}  // namespace reprise::cli

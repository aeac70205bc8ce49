#include "reprise/self_distance.h"

#include <algorithm>
#include <cmath>

#include "archive/space_training.h"
#include "rma/behaviour_groups.h"
#include "rma/behaviour_segments.h"
#include "rma/clip_extents.h"
#include "rma/self_distance_plot.h"

namespace reprise {
namespace {

constexpr double most_samples = 2000;

std::vector<SelfDistance::Behaviour> behaviours_of(const PostureMatrix& projected, double rate) {
  std::vector<long> borders = behaviour_cuts(projected, rate);
  borders.insert(borders.begin(), 0);
  borders.push_back(projected.rows());
  std::vector<SegmentShape> shapes;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    shapes.push_back(segment_shape(projected.middleRows(borders[i], borders[i + 1] - borders[i])));
  }
  const std::vector<int> groups = group_segments(shapes);
  std::vector<SelfDistance::Behaviour> behaviours;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    behaviours.push_back({static_cast<double>(borders[i]) / rate,
                          static_cast<double>(borders[i + 1]) / rate, groups[i] + 1});
  }
  return behaviours;
}

std::vector<ClipInfo> clips_of(const Archive& archive, const TakeInfo& take) {
  TakeFilter filter;
  filter.take = take.name;
  std::vector<ClipInfo> clips = archive.clips(filter);
  std::erase_if(clips, [&](const ClipInfo& clip) { return clip.take != take.name; });
  return clips;
}

}  // namespace

SelfDistance self_distance(const Archive& archive, const TakeInfo& info) {
  const Take take = archive.extract(info, FidelityTier::preview);
  RepeatConstants constants;
  constants.next_near_s = 0;  // near pairs are minima of the plot, not windows
  constants.rate = std::min(constants.rate, most_samples / std::max(take.seconds(), 1.0));
  const LayoutChoices layout = choose_layout(*take.skeleton, layout_evidence(prepare_take(take)));
  const PostureLibrary library(
      {aligned_postures(take, {layout.root_joint, layout.up_axis}, constants.rate)}, constants);
  const PostureMatrix& projected = library.projected.front();
  const PostureMatrix distances = self_distances(projected);
  const std::vector<NearPair> minima = plot_minima(distances, 0, constants);

  SelfDistance plot;
  plot.rate = constants.rate;
  plot.samples = projected.rows();
  plot.distance_mm.assign(distances.data(), distances.data() + distances.size());
  for (const TracedPath& traced : trace_paths(library, minima, constants)) {
    std::vector<SelfDistance::Pixel>& path = plot.paths.emplace_back();
    for (const PlotPixel& pixel : traced.path.pixels) path.push_back({pixel.x, pixel.y});
  }
  plot.behaviours = behaviours_of(projected, constants.rate);
  plot.clips = clips_of(archive, info);
  // The last sample stands for what is left of the take.
  plot.behaviours.back().end = take.seconds();
  return plot;
}

}  // namespace reprise

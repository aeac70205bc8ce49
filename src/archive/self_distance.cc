#include "reprise/self_distance.h"

#include <algorithm>
#include <cmath>

#include "archive/space_training.h"
#include "rma/behaviour_groups.h"
#include "rma/behaviour_segments.h"
#include "rma/clip_choice.h"
#include "rma/clip_extents.h"
#include "rma/self_distance_plot.h"

namespace reprise {
namespace {

constexpr double most_samples = 2000;

ClipKind kind_of(ClipRole role) {
  switch (role) {
    case ClipRole::primary:
      return ClipKind::primary;
    case ClipRole::repeated:
      return ClipKind::repeated;
    case ClipRole::unique:
      break;
  }
  return ClipKind::unique;
}

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

std::vector<SelfDistance::Clip> clips_of(const PostureLibrary& library,
                                         const std::vector<NearPair>& minima,
                                         const RepeatConstants& constants) {
  const auto groups = find_repeat_groups(library, minima, std::nullopt, constants);
  std::vector<SelfDistance::Clip> clips;
  for (const ChosenClip& chosen : choose_clips(library, groups, constants)) {
    SelfDistance::Clip clip{static_cast<double>(chosen.begin) / constants.rate,
                            static_cast<double>(chosen.end) / constants.rate, kind_of(chosen.role),
                            std::nullopt};
    if (chosen.role == ClipRole::repeated) clip.primary = chosen.primary;
    clips.push_back(clip);
  }
  return clips;
}

}  // namespace

SelfDistance self_distance(const Archive& archive, const TakeInfo& info) {
  const Take take = archive.extract(info, FidelityTier::preview);
  RepeatConstants constants;
  constants.explained_cover = 2;  // clips are chosen from all groups
  constants.short_share = 1;
  constants.least_near_per_s = 0;  // near pairs are minima of the plot, not windows
  constants.next_near_s = 0;
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
  plot.clips = clips_of(library, minima, constants);
  // The last sample stands for what is left of the take.
  plot.behaviours.back().end = take.seconds();
  plot.clips.back().end = take.seconds();
  return plot;
}

}  // namespace reprise

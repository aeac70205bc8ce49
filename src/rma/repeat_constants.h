// Constants of the search for repeated motion.
#pragma once

namespace reprise {

struct RepeatConstants {
  /// Postures a second. Half of a capture at 30 frames a second; finer changes nothing (see
  /// docs/findings/2026-11-25-repeated-motion.md, as for all that is called measured here).
  double rate = 15;
  /// Leading axes of the postures: lin-2011 section 4.1 has 5-15.
  int axes = 16;

  /// Pixels of the self-distance plot further than this are dissimilar (mm), where a posture's
  /// reach, the distance that holds this part of a library's postures, is reach_mm (mm). Measured.
  float similar_mm = 80;
  double reach_part = 0.1;
  float reach_mm = 100;
  /// What is similar follows the reach (PostureLibrary::follow_reach). Below reach_mm in
  /// proportion: otherwise paths run on through stands, of which each is within similar_mm of all
  /// others. Above it with this power: large motion is done again less exactly, and nothing else is
  /// near it. Measured (docs/findings/2026-12-01-one-meaning-of-repeated.md).
  float far_reach_power = 0.5F;
  /// A path goes on over dissimilar pixels for this long (s). lin-2011 section 4.2.1.
  double bridge_s = 0.3;
  /// The least Manhattan length of a path (s). lin-2011 section 4.2.1.
  double least_path_s = 0.6;
  /// The steepest and, inverted, the flattest slope of a path. lin-2011 keeps both without a limit;
  /// it has to be more than 2, so that noise does not end the path of a clip at twice the speed.
  static constexpr int steepest = 3;
  /// similar_mm and member_mm between takes of different subjects are this many times as wide,
  /// where it is known who moves (PostureLibrary::subjects): people do the same thing differently.
  /// Measured (docs/findings/2026-11-25-behaviours.md).
  float across_subjects = 1.5F;
  /// A take is not compared with itself nearer to the diagonal than this (s).
  double least_lag_s = 0.4;

  /// A member's greatest mean joint distance to its group's reference (mm), where similar_mm holds
  /// for all of the reference; in proportion where less or more is similar. Measured.
  float member_mm = 60;
  /// For clips shorter than this (s) it is less, down to this part of it for the shortest path:
  /// short motions are alike by accident. Measured.
  double whole_clip_s = 1.5;
  float short_share = 0.75F;
  /// Where somebody asks for one clip of which less is similar, a member may be further by this
  /// factor, up to member_mm: whoever asks sees distances, and misses what is left out. Measured.
  float asked_share = 1.2F;
  /// Paths are traced only through places that others within this time (s) go on from, or to; 0:
  /// through all. Single places that are near lead to paths that are too short. Measured.
  double next_near_s = 0.4;
  /// A stretch is held against a clip where this many places a second of the clip are near to
  /// places in it (of a clip's windows, five begin a second): most stretches that a place or two
  /// lead to repeat nothing, and the larger a library is, the more there are. Measured.
  double least_near_per_s = 3.5;
  /// The shortest clip that is reported, or stored as primary or repeated (s).
  double least_clip_s = 0.6;
  /// The longest (s); what recurs for longer is cut into equal parts. To hold a clip against a take
  /// costs the product of their lengths.
  double most_clip_s = 60;
  /// No group is looked for around a clip of which this part is in this many groups already: that
  /// every moment is told dozens of times helps nobody, and takes longer the larger a library is.
  /// A part above 1: groups overlap as they like. Measured.
  double explained_cover = 0.6;
  int explained_times = 2;
  /// A clip whose joints move less than this on average (mm/s) is a stance, not a motion: standing
  /// people sway by about 10, and waving one hand moves all joints by 40. Measured.
  double least_speed_mm_s = 20;
};

}  // namespace reprise

#include "synth/behaviours.h"

#include <algorithm>

#include "synth/gesture_parts.h"
#include "synth/gestures.h"

namespace reprise::synth {
namespace {

/// Steps that take about `seconds`.
int step_count(const GaitStyle& style, double seconds) {
  return std::max(3, static_cast<int>((seconds - 0.48) / style.step_seconds));
}

Performance perform_stepping(Behaviour behaviour, Random& random, double seconds) {
  GaitStyle style =
      behaviour == Behaviour::run ? random_run_style(random) : random_walk_style(random);
  double turn = random.uniform(-70, 70);
  double direction = 0;
  if (behaviour == Behaviour::turn) {
    style.step_length = 0;
    turn = random_sign(random);
    turn *= random.uniform(90, 220);
  } else if (behaviour == Behaviour::side_steps) {
    style.step_length = random.uniform(0.2, 0.36);
    direction = random.chance(0.5) ? 90 : -90;
    turn = random.uniform(-20, 20);
  } else if (behaviour == Behaviour::march) {
    style.step_length = random.uniform(0, 0.3);
    style.lift = random.uniform(0.25, 0.45);
    style.arm_swing = 60;
    turn = random.uniform(-120, 120);
  }
  const int steps = std::max(step_count(style, seconds), behaviour == Behaviour::turn ? 4 : 3);
  Performance p = perform_steps(style, steps, turn, direction, random_side(random));
  if (behaviour != Behaviour::run && random.chance(0.5))
    busy_arm(p, random, random_side(random), 2);
  return p;
}

void perform_standing(Performance& p, Behaviour behaviour, Random& random) {
  switch (behaviour) {
    case Behaviour::wave:
      return wave(p, random, false);
    case Behaviour::wave_both:
      return wave(p, random, true);
    case Behaviour::punch:
      return punch(p, random);
    case Behaviour::kick:
      return kick(p, random);
    case Behaviour::squat:
      return squat(p, random);
    case Behaviour::crouch:
      return crouch(p, random);
    case Behaviour::jump:
      return jump(p, random);
    case Behaviour::reach_down:
      return reach_down(p, random);
    case Behaviour::reach_up:
      return reach_up(p, random);
    case Behaviour::bow:
      return bow(p, random);
    case Behaviour::arm_circles:
      return arm_circles(p, random);
    case Behaviour::lunge:
      return lunge(p, random);
    case Behaviour::throw_ball:
      return throw_ball(p, random);
    case Behaviour::clap:
      return clap(p, random);
    case Behaviour::swing:
      return swing(p, random);
    case Behaviour::stretch:
      return stretch(p, random);
    case Behaviour::dance:
      return dance(p, random);
    case Behaviour::balance:
      return balance(p, random);
    default:
      for (const Side side : {Side::left, Side::right}) busy_arm(p, random, side, 3);
  }
}

bool is_stepping(Behaviour behaviour) {
  return behaviour == Behaviour::turn || behaviour == Behaviour::side_steps ||
         behaviour == Behaviour::march || behaviour == Behaviour::walk ||
         behaviour == Behaviour::run;
}

}  // namespace

Performance perform(Behaviour behaviour, Random& random, double most_seconds) {
  const double most = std::max(1.2, most_seconds);
  double shortest = std::min(1.7, most);
  if (behaviour == Behaviour::punch) shortest = 1.0;
  if (behaviour == Behaviour::jump) shortest = 1.6;
  const double seconds = random.uniform(shortest, std::max(shortest, most - 0.2));
  Performance p(seconds);
  if (is_stepping(behaviour)) {
    p = perform_stepping(behaviour, random, seconds);
    add_person(p, random, false);
  } else {
    add_person(p, random, true);
    perform_standing(p, behaviour, random);
    p.smooth(pelvis_x, foot_tracks, 0.05);
    set_stance(p, random);
  }
  p.smooth(torso_pitch, track_count, 0.035);
  return p;
}

Performance perform_idle(double seconds, Random& random) {
  Performance p(seconds);
  const double slow = random.uniform(0.12, 0.25);
  p.add_oscillation(pelvis_x, {0, seconds, slow, random.uniform(0.01, 0.05), random.uniform(0, 6)});
  p.add_oscillation(pelvis_z,
                    {0, seconds, slow * 1.7, random.uniform(0.004, 0.012), random.uniform(0, 6)});
  p.add_oscillation(pelvis_roll,
                    {0, seconds, slow, random.uniform(0.5, 2.5), random.uniform(0, 6)});
  p.add_oscillation(torso_pitch, {0, seconds, 0.27, random.uniform(0.5, 1.5), 0});  // breathing
  p.add_oscillation(torso_twist,
                    {0, seconds, slow * 0.8, random.uniform(2, 8), random.uniform(0, 6)});
  p.add_oscillation(head_twist,
                    {0, seconds, slow * 1.3, random.uniform(5, 25), random.uniform(0, 6)});
  p.add_oscillation(head_pitch,
                    {0, seconds, slow * 1.1, random.uniform(2, 8), random.uniform(0, 6)});
  for (const Side side : {Side::left, Side::right}) {
    if (seconds > 1.8 && random.chance(0.3))
      hold_arm(p, random, side, random.chance(0.5) ? ArmPlace::hip : ArmPlace::across, 0.25, 0.75);
    p.add_oscillation(arm_track(side, arm_y),
                      {0, seconds, slow, random.uniform(1, 5), random.uniform(0, 6)});
    p.add_oscillation(arm_track(side, elbow),
                      {0, seconds, slow * 1.4, random.uniform(1, 6), random.uniform(0, 6)});
  }
  return p;
}

}  // namespace reprise::synth

#include "synth/random.h"

namespace reprise::synth {
namespace {

constexpr std::uint64_t golden_gamma = 0x9e3779b97f4a7c15u;

std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

}  // namespace

Random Random::fork(std::uint64_t label) const {
  return Random(mix(mix(state_ + golden_gamma) ^ mix(label * golden_gamma + 1)));
}

std::uint64_t Random::next() { return mix(state_ += golden_gamma); }

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::size_t Random::below(std::size_t count) { return static_cast<std::size_t>(next() % count); }

bool Random::chance(double probability) { return uniform() < probability; }

double Random::gaussian() {
  const std::uint64_t bits = next();
  double sum = 0;
  for (int part = 0; part < 4; ++part) {
    sum += (static_cast<double>((bits >> (16 * part)) & 0xffffu) + 0.5) * 0x1p-16 - 0.5;
  }
  return sum * 1.7320508075688772;  // a sum of four has the variance 4/12
}

}  // namespace reprise::synth

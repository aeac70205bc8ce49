#include "quant/cosine_transform.h"

#include <bit>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace reprise {
namespace {

using Eigen::Index;

/// cos(x) for |x| <= pi/4 and sin(x) by their series, in basic operations, which every compiler
/// rounds alike.
double cosine_series(double x) {
  double sum = 1, term = 1;
  for (int n = 2; n <= 22; n += 2) sum += (term *= -x * x / (n * (n - 1)));
  return sum;
}
double sine_series(double x) {
  double sum = x, term = x;
  for (int n = 3; n <= 23; n += 2) sum += (term *= -x * x / (n * (n - 1)));
  return sum;
}

/// cos(2 pi i / 4n) for i = 0 .. 4n - 1.
std::vector<double> cosine_circle(Index n) {
  std::vector<double> circle(static_cast<std::size_t>(4 * n));
  const auto at = [&](Index i) -> double& { return circle[static_cast<std::size_t>(i)]; };
  for (Index i = 0; i <= n; ++i) {  // a quarter of the circle
    const double from_zero =
        std::numbers::pi * static_cast<double>(i) / (2.0 * static_cast<double>(n));
    const double to_quarter =
        std::numbers::pi * static_cast<double>(n - i) / (2.0 * static_cast<double>(n));
    at(i) = 2 * i <= n ? cosine_series(from_zero) : sine_series(to_quarter);
  }
  for (Index i = 0; i < n; ++i) at(2 * n - i) = -at(i);
  for (Index i = 1; i < 2 * n; ++i) at(4 * n - i) = at(i);
  return circle;
}

using ComplexVector = std::vector<std::complex<double>>;

/// A Fourier transform that is fast at every length, which takes of a prime number of frames need:
/// L. Bluestein, A linear filtering approach to the computation of discrete Fourier transform,
/// 1970.
class FourierTransform {
 public:
  explicit FourierTransform(Index length)
      : chirp_(static_cast<std::size_t>(length)),
        filter_(std::bit_ceil(2 * static_cast<std::size_t>(length))) {
    for (Index k = 0; k < length; ++k) {
      // k^2 modulo the period keeps the angle exact in long takes.
      const double turned = static_cast<double>(k * k % (2 * length));
      const auto value = std::polar(1.0, -std::numbers::pi * turned / static_cast<double>(length));
      chirp_[static_cast<std::size_t>(k)] = value;
      filter_[static_cast<std::size_t>(k)] = std::conj(value);
      if (k > 0) filter_[filter_.size() - static_cast<std::size_t>(k)] = std::conj(value);
    }
    ComplexVector spectrum;
    fourier_.fwd(spectrum, filter_);
    filter_ = std::move(spectrum);
  }

  ComplexVector transformed(const ComplexVector& values) {
    ComplexVector padded(filter_.size()), spectrum;
    for (std::size_t i = 0; i < values.size(); ++i) padded[i] = values[i] * chirp_[i];
    fourier_.fwd(spectrum, padded);
    for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] *= filter_[i];
    fourier_.inv(padded, spectrum);
    padded.resize(values.size());
    for (std::size_t i = 0; i < padded.size(); ++i) padded[i] *= chirp_[i];
    return padded;
  }

 private:
  Eigen::FFT<double> fourier_;
  ComplexVector chirp_, filter_;
};

}  // namespace

void frames_to_cosines(Eigen::Ref<Eigen::MatrixXd> trajectories) {
  // J. Makhoul, A fast cosine transform in one and two dimensions, 1980: one Fourier transform of
  // the even frames followed by the odd ones backwards.
  const Index n = trajectories.rows();
  if (n <= 1) return;
  FourierTransform fourier(n);
  ComplexVector shuffled(static_cast<std::size_t>(n));
  for (Index c = 0; c < trajectories.cols(); ++c) {
    for (Index i = 0; i < n; ++i) {
      const Index place = i % 2 == 0 ? i / 2 : n - 1 - i / 2;
      shuffled[static_cast<std::size_t>(place)] = trajectories(i, c);
    }
    const ComplexVector spectrum = fourier.transformed(shuffled);
    for (Index k = 0; k < n; ++k) {
      const double angle =
          -std::numbers::pi * static_cast<double>(k) / (2.0 * static_cast<double>(n));
      const double norm = std::sqrt((k == 0 ? 1.0 : 2.0) / static_cast<double>(n));
      trajectories(k, c) =
          norm * (std::polar(1.0, angle) * spectrum[static_cast<std::size_t>(k)]).real();
    }
  }
}

void cosines_to_frames(Eigen::Ref<Eigen::MatrixXd> cosines) {
  const Index n = cosines.rows();
  if (n == 0) return;
  const std::vector<double> circle = cosine_circle(n);
  Eigen::MatrixXd frames = Eigen::MatrixXd::Zero(n, cosines.cols());
  Eigen::VectorXd wave(n);
  for (Index k = 0; k < n; ++k) {
    if ((cosines.row(k).array() == 0.0).all()) continue;
    const double norm = std::sqrt((k == 0 ? 1.0 : 2.0) / static_cast<double>(n));
    for (Index i = 0; i < n; ++i) {
      wave[i] = norm * circle[static_cast<std::size_t>((2 * i + 1) * k % (4 * n))];
    }
    for (Index c = 0; c < cosines.cols(); ++c) {
      if (cosines(k, c) != 0.0) frames.col(c) += cosines(k, c) * wave;
    }
  }
  cosines = frames;
}

}  // namespace reprise

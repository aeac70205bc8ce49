// The coarsest coding of a take that keeps its fidelity, measured on what the decoder makes of it.
#pragma once

#include "quant/take_codec.h"
#include "quant/take_header.h"
#include "reprise/archive.h"
#include "reprise/model/kinematics.h"

namespace reprise {

struct FitConstants {
  /// A step is kept only if the mean error is this much below what was promised (part of it), for
  /// what rounding to the decimals of a file and another build's arithmetic may add.
  static constexpr double margin = 1e-4;
  /// A take fits a space if its axes leave no more than this part of the allowed mean error.
  static constexpr double most_residual = 0.65;
  /// The quantiser's step for a millimetre of mean error, about.
  static constexpr double step_per_millimetre = 2.2;
};

struct FittedTake {
  CodedMotion motion;
  KnotShape shape;
  double mean_mm = 0;  ///< over all joints and frames of the prepared take
  bool kept = false;   ///< false: not even the finest step keeps the fidelity
};

/// The step that the search begins with.
int guessed_step(double mean_mm);

/// Root mean square distance (mm a point) that the axes of a space leave of a take's markers.
double residual_mm(const CoefficientSpace& space, const MarkerMatrix& markers);

/// The mean error (mm) that the coarsest layer of a take keeps, whatever the layers above it bring.
double coarse_mean_mm(const Fidelity& fidelity);

struct FitOptions {
  double mean_mm = FidelityLimits::preview_mean_mm;
  bool contacts = true;  ///< feet are held where they stand
};
/// What an ingest asks of its takes' coarsest layers.
FitOptions fit_options(const IngestOptions& options);

/// `model` is where the contexts of the space's takes start.
FittedTake fit_take(const CoefficientSpace& space, const KnotModel& model,
                    const PreparedTake& prepared, const FitOptions& options);

}  // namespace reprise

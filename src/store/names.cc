// Names of the values that archives hold as numbers.
#include "reprise/archive.h"

namespace reprise {

Fidelity fidelity_of(FidelityTier tier) {
  switch (tier) {
    case FidelityTier::preview:
      return {tier, FidelityLimits::preview_mean_mm, 0};
    case FidelityTier::fine:
      return {tier, FidelityLimits::fine_mm, FidelityLimits::fine_deg};
    case FidelityTier::exact:
      return {tier, 0, 0};
    default:
      return {tier, FidelityLimits::standard_mm, FidelityLimits::standard_deg};
  }
}

std::string tier_name(FidelityTier tier) {
  switch (tier) {
    case FidelityTier::preview:
      return "preview";
    case FidelityTier::standard:
      return "standard";
    case FidelityTier::fine:
      return "fine";
    case FidelityTier::exact:
      return "exact";
    case FidelityTier::bound:
      return "bound";
  }
  return "unknown";
}

std::string clip_kind_name(ClipKind kind) {
  switch (kind) {
    case ClipKind::primary:
      return "primary";
    case ClipKind::repeated:
      return "repeated";
    case ClipKind::unique:
      return "unique";
  }
  return "unknown";
}

}  // namespace reprise

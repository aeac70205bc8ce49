// A picture of few colours.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace reprise::cli {

/// Indices of a canvas's palette: shades from black to white, and then these.
namespace ink {
constexpr int shades = 32;
constexpr int white = shades - 1, black = 0;
constexpr int path = shades, primary = shades + 1, repeated = shades + 2, unique = shades + 3;
/// This one and those after it, in turn.
constexpr int behaviour = shades + 4, behaviours = 8;
}  // namespace ink

struct CanvasPoint {
  double x = 0;  ///< pixels from the left
  double y = 0;  ///< from the top
};

/// What lies outside is not drawn.
class Canvas {
 public:
  /// White; both at least 1.
  Canvas(long width, long height);

  void set(long x, long y, int colour);
  void fill(long x0, long x1, long y0, long y1, int colour);
  /// Ends included, `thickness` pixels wide.
  void line(CanvasPoint from, CanvasPoint to, double thickness, int colour);

  /// A PNG file. Throws Error (failed) where memory is short.
  std::string png() const;

 private:
  long width_, height_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace reprise::cli

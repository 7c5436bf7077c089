// SPDX-License-Identifier: Apache-2.0
// Ray-traces a scene: captured views, disparity map, coverage and thin-lens ground truth. The
// output does not depend on the number of threads or the machine. LightCurve converts codes to
// light and back, and SceneOpening is the opening of the lens.
#ifndef STARFOCUS_EXAMPLES_SCENE_RENDER_H_
#define STARFOCUS_EXAMPLES_SCENE_RENDER_H_

#include <vector>

#include "examples/scene/scene.h"
#include "platform/image.h"
#include "platform/pfm.h"
#include "platform/progress.h"
#include "platform/runner.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

// Pictures of a scene are averages of light. Codes up to kMostCode, where 255 is white, are
// converted to light in units of 1/255 of white. The tables use only IEEE 754 arithmetic, so that
// they are equal on all machines.
class LightCurve {
 public:
  explicit LightCurve(starfocus_transfer transfer);

  Color Decode(const Color& codes) const;
  Color Encode(const Color& light) const;

 private:
  // Largest code of the table, and number of table entries per code.
  static constexpr int kMostCode = 2048, kSteps = 4;

  double LightOf(double code) const;
  double CodeOf(double light) const;

  std::vector<double> light_;  // light of every table entry; empty if light equals the code
};

// The opening of a thin lens, in double precision. This class shares no code with the engine.

class SceneOpening {
 public:
  // @param lens a valid lens
  explicit SceneOpening(const starfocus::Params& lens);

  // Returns cot^2(theta) of the density (3), or 0 if the opening is equally bright everywhere.
  double fall_off() const { return fall_off_; }

  // Returns approximately the fraction of the disc through which light reaches a corner of the
  // picture.
  double LeastShare() const;

  // Returns true if the ray through point (u, v) of the unit disc passes the opening. (x, y) is the
  // position of the pixel relative to the centre of the picture, in half diagonals.
  bool Passes(double u, double v, double x, double y) const;

 private:
  struct Edge {
    double x, y;  // normal of the edge
  };

  starfocus_shape shape_;
  double fall_off_ = 0, inner_, cats_eye_;
  // Curvature of a polygon's edges, and half the angle between two corners.
  double curvature_, half_;
  std::vector<Edge> edges_;
};

// Ray-traces a scene: captured views, disparity map, coverage and thin-lens ground truth. The
// output does not depend on the number of threads or the machine.

// Smallest and largest disparity in focus, in pixels per unit of u. Both are equal for a thin lens.
struct SceneFocus {
  double far, near;
};

// Light of a picture, in rows without padding; white is 255.
struct SceneLight {
  int width, height;
  std::vector<Color> pixels;
};

// Approximate number of lens samples per pixel of the ground truth. A lamp 64 times as bright as
// white needs more, because each sample that meets it adds a quarter of white with 256. Moving
// scenes need more, because noise of the ground truth changes from frame to frame.
inline constexpr int kLensSamples = 256, kFineLensSamples = 1024;

class RayTracer {
 public:
  // The colour of a pixel is the average linear light of its rays. `transfer` defines how codes
  // represent light.
  RayTracer(const Scene& scene, int width, int height, starfocus_transfer transfer,
            ThreadRunner* runner);

  // Weights of rows in the reported progress. A row of a view counts once, a row of ground truth
  // kTruthCost times, and a row of coverage kCoverageCost times. `progress` may be null.
  static constexpr int kTruthCost = 16, kCoverageCost = 2;

  // Renders the view of a pinhole at (u, v). Every pixel is the mean of the light over the area of
  // the pixel.
  SceneLight ViewLight(double u, double v, Progress* progress) const;
  Image View(double u, double v, Progress* progress) const {
    return Encoded(ViewLight(u, v, progress));
  }

  // Returns the disparity of the centre view at pixel centres, in pixels per unit of u.
  FloatMap Disparity() const;

  // Returns the fraction of each pixel of the centre view that the foreground covers; 255 is the
  // whole pixel. The fraction is the mean of 256 rays. Each ray lies in a different 256th of the
  // pixel's width and in a different 256th of the pixel's height.
  std::vector<uint8_t> Coverage(Progress* progress) const;

  // Renders the picture of a lens with radius `aperture` and opening `opening`. With a range in
  // focus, the rays of a pixel coincide inside the range and diverge from its ends. A set of
  // strands must not extend beyond an end of the range, because only its nearest strand on each
  // straight part of a ray is found.
  SceneLight TruthLight(const SceneFocus& focus, double aperture, const SceneOpening& opening,
                        int samples, Progress* progress) const;
  Image Truth(const SceneFocus& focus, double aperture, const SceneOpening& opening,
              Progress* progress) const {
    return Encoded(TruthLight(focus, aperture, opening, kLensSamples, progress));
  }

  // Returns a picture as codes of 8 bits, and as half floats of linear light, of which 1 is white.
  Image Encoded(const SceneLight& picture) const;
  DeepImage Halves(const SceneLight& picture) const;

  // Converts the scene's nearest point at canvas position (x, y) to the coordinates of the pixel in
  // which the camera's centre view shows it.
  void ToPixel(double x, double y, int* pixel_x, int* pixel_y) const;

 private:
  struct Lens;  // a lens, which defines the rays that contribute to a pixel

  // Returns the indices of the surfaces that may be visible in the tile at (x0, y0), nearest first.
  std::vector<size_t> Candidates(const Lens& lens, int x0, int y0) const;
  // Finds the nearest surface on a ray of the camera whose disparity is at most `most`.
  const Surface* Trace(const std::vector<size_t>& candidates, const Ray& ray, double most,
                       Hit* hit) const;
  // Finds the nearest surface that canvas position `p` shows through lens position `q`.
  const Surface* TraceLens(const Lens& lens, const std::vector<size_t>& candidates, Point p,
                           Point q, Hit* hit) const;
  // Returns the light at pixel position (x, y) through lens position (u, v).
  Color RayColor(const Lens& lens, const std::vector<size_t>& candidates, double x, double y,
                 double u, double v) const;
  // Returns the mean light of grid * grid samples of pixel (x, y).
  Color ViewPixel(const Lens& lens, const std::vector<size_t>& candidates, int x, int y,
                  int grid) const;
  Color LensPixel(const Lens& lens, const std::vector<size_t>& candidates, int x, int y) const;
  // Returns the coverage of pixel (x, y), 0 to 255.
  uint8_t CoverageOf(const std::vector<size_t>& candidates, int x, int y) const;
  // Returns true if `kind` returns true for at least one of the candidate surfaces.
  template <class Kind>
  bool Any(const std::vector<size_t>& candidates, const Kind& kind) const;
  // Returns the ray of the centre view through pixel position (x, y).
  Ray CentreRay(double x, double y) const;
  void RenderTile(const Lens& lens, int x0, int y0, SceneLight* picture) const;
  SceneLight Render(const Lens& lens, Progress* progress) const;
  // Calls body(y) for the first row y of every band of tiles. Each row counts as `steps` of
  // progress.
  template <class Body>
  void ForBands(Progress* progress, int steps, const Body& body) const;
  // Calls body(candidates, x, y) for all pixels of the centre view.
  template <class Body>
  void ForCentrePixels(Progress* progress, int steps, const Body& body) const;

  const Scene& scene_;
  const int width_, height_;
  const double scale_;  // number of pixels per canvas unit
  const LightCurve curve_;
  std::vector<Bounds> bounds_;
  ThreadRunner* const runner_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_RENDER_H_

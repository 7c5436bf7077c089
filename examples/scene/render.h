// SPDX-License-Identifier: Apache-2.0
// Pictures of a scene: captured views, disparity map and thin-lens ground truth. Output depends on
// neither the number of threads nor the machine.
#ifndef STARFOCUS_EXAMPLES_SCENE_RENDER_H_
#define STARFOCUS_EXAMPLES_SCENE_RENDER_H_

#include "examples/scene/light_curve.h"
#include "examples/scene/opening.h"
#include "examples/scene/scene.h"
#include "platform/image.h"
#include "platform/pfm.h"
#include "platform/progress.h"
#include "platform/runner.h"

namespace starfocus {

class RayTracer {
 public:
  // Pictures are means of light, as `transfer` has it.
  RayTracer(const Scene& scene, int width, int height, starfocus_transfer transfer,
            ThreadRunner* runner);

  // Progress counts rows, rows of ground truth kTruthCost times, and rows of coverage kCoverageCost
  // times; null for none.
  static constexpr int kTruthCost = 16, kCoverageCost = 2;

  // What a pinhole at (u, v) sees, every pixel the mean over its box.
  Image View(double u, double v, Progress* progress) const;

  // Disparity of the centre view at pixel centres, in pixels per unit u.
  FloatMap Disparity() const;

  // Share of every pixel of the centre view that the foreground covers: 255 for all of it. It is
  // the mean of 256 rays, each in another 256th of the pixel's columns and of its rows.
  std::vector<uint8_t> Coverage(Progress* progress) const;

  // What a lens of radius `aperture` with this opening, focused at `focus`, sees.
  Image Truth(double focus, double aperture, const SceneOpening& opening, Progress* progress) const;

  // Pixel of a point of the canvas.
  void ToPixel(double x, double y, int* pixel_x, int* pixel_y) const;

 private:
  struct Lens;  // which rays make a pixel

  // Indices of the surfaces that the tile at (x0, y0) may see, nearest first.
  std::vector<size_t> Candidates(const Lens& lens, int x0, int y0) const;
  const Surface* Trace(const std::vector<size_t>& candidates, const Ray& ray, Hit* hit) const;
  // Light seen from pixel position (x, y) through lens position (u, v).
  Color RayColor(const Lens& lens, const std::vector<size_t>& candidates, double x, double y,
                 double u, double v) const;
  // `grid`: samples of the pixel, squared.
  Color ViewPixel(const Lens& lens, const std::vector<size_t>& candidates, int x, int y,
                  int grid) const;
  Color LensPixel(const Lens& lens, const std::vector<size_t>& candidates, int x, int y) const;
  // Returns 0 to 255.
  uint8_t CoverageOf(const std::vector<size_t>& candidates, int x, int y) const;
  // Returns true if one of the candidates is of a kind.
  template <class Kind>
  bool Any(const std::vector<size_t>& candidates, const Kind& kind) const;
  // Ray of the centre view through pixel position (x, y).
  Ray CentreRay(double x, double y) const;
  void RenderTile(const Lens& lens, int x0, int y0, Image* image) const;
  Image Render(const Lens& lens, Progress* progress) const;
  // Calls body(y) for the first row y of every band of tiles; a row makes `steps` of progress.
  template <class Body>
  void ForBands(Progress* progress, int steps, const Body& body) const;
  // Calls body(candidates, x, y) for all pixels of the centre view.
  template <class Body>
  void ForCentrePixels(Progress* progress, int steps, const Body& body) const;

  const Scene& scene_;
  const int width_, height_;
  const double scale_;  // pixels per canvas unit
  const LightCurve curve_;
  std::vector<Bounds> bounds_;
  ThreadRunner* const runner_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_RENDER_H_

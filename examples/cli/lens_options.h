// SPDX-License-Identifier: Apache-2.0
// Chooses the aperture and the focus from the options and from the lens of the input, within the
// limit of STARFOCUS_MAX_BLUR pixels of blur, for the commands refocus, video and view.
#ifndef STARFOCUS_EXAMPLES_CLI_LENS_OPTIONS_H_
#define STARFOCUS_EXAMPLES_CLI_LENS_OPTIONS_H_

#include <optional>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

// Options of the command line that set the aperture.
struct ApertureOptions {
  std::optional<double> aperture, f_stop, widest, strength;
};

struct ApertureChoice {
  double radius = 1;      // Radius at the requested strength.
  double widest = 1;      // F-stop of an aperture of radius 1.
  double strength = 1;    // Strength from 0 to 1; `radius` already includes this factor.
  std::string option;     // Option that set the radius; empty: the default.
  std::string value;      // Value of `option` as typed.
  bool narrowed = false;  // True if the default exceeded the blur limit and was reduced.
  std::string remedy;     // What enlarges a blur below a pixel; empty unless the input is a photo.
  double blur = 0;        // Largest blur radius in pixels; set by FitAperture.
};

// Evaluates the options. The default aperture is the f-stop of the input if known, otherwise radius
// 1.
Result<ApertureChoice> PlanAperture(const ApertureOptions& options, const Capture& capture);

// Returns the largest distance of a disparity of the map from any of the foci, in pixels. `lens`
// extends each focus to a range; other fields of `lens` are ignored.
double FarthestFromFocus(const starfocus_disparity_stats& stats, const std::vector<double>& foci,
                         const starfocus::Params& lens = {});

// Returns the largest blur radius in pixels of a pixel that counts as in focus: 1/3000 of the
// picture's diagonal, but at least one pixel. The diameter of the blur is then at most 1/1500 of
// the diagonal, which is the usual limit for the depth of field.
double SharpRadius(int width, int height);

// Fits the aperture to the blur limit. `range` is the largest distance of a disparity from the
// focus, in pixels. If the blur exceeds the limit, reduces a default aperture, but returns an error
// for an aperture that the user chose.
Error FitAperture(double range, ApertureChoice* aperture);

// Prints notes to stderr: the f-stop that replaces the default if the default aperture was reduced,
// and the largest blur if it is less than a pixel, as with a wrong unit of distances.
void TellAperture(const std::string& path, const ApertureChoice& aperture);

struct DefaultFocus {
  bool at_pixel = true;
  int x = 0, y = 0;      // Pixel in focus.
  double disparity = 0;  // Disparity in focus if at_pixel is false.
  std::string source;    // Description of the origin of the focus, for users.
};

// Returns the subject of the matte if the photo has no depth. Otherwise returns, in this order of
// preference, the subject in EXIF, the focus stored in the file, the subject of the matte, or the
// result of FindSurface. The disparity of the subject is the median of the map where alpha is at
// least 3/4, or 1/2 if none of 256x256 places has
// 3/4. Coordinates are pixels of the picture. The map must be
// loaded. The map may contain unknown values and may differ in size from the picture.
DefaultFocus FindDefaultFocus(const Capture& capture);

// Returns a pixel of the nearest large surface near the centre. A large surface has similar
// disparities, and covers at least a tenth of the central area with half the width and height of
// the map. Returns the centre of the map if all disparities in the middle half are unknown.
// Coordinates are pixels of the map.
DefaultFocus FindSurface(const FloatMap& map);

// Prints the origin of the focus to stderr.
void TellFocus(const std::string& path, const DefaultFocus& focus);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_LENS_OPTIONS_H_

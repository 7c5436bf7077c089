// SPDX-License-Identifier: Apache-2.0
// The aperture of a refocusing, from the options and what the input knows of its lens, and the
// limit that STARFOCUS_MAX_BLUR pixels of blur set to it. Used by refocus, video and view.
#ifndef STARFOCUS_EXAMPLES_CLI_REFOCUS_APERTURE_H_
#define STARFOCUS_EXAMPLES_CLI_REFOCUS_APERTURE_H_

#include <optional>
#include <string>
#include <vector>

#include "platform/readers/capture.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// What is typed.
struct ApertureOptions {
  std::optional<double> aperture, f_stop, widest, strength;
};

struct ApertureChoice {
  double radius = 1;      // at the strength asked for
  double widest = 1;      // f-stop of radius 1
  double strength = 1;    // 0 to 1, a part of `radius` already
  std::string option;     // that the user chose the radius by; empty: the default
  std::string value;      // of that option, as typed
  bool narrowed = false;  // the default was too wide for the limit of blur
};

// Reads the options, whose default is the f-stop of the input, if it has one, else radius 1.
Result<ApertureChoice> PlanAperture(const ApertureOptions& options, const Capture& capture);

// Largest difference between a disparity of the map and one of the foci.
double FarthestFromFocus(const starfocus_disparity_stats& stats, const std::vector<double>& foci);

// Fits the aperture to the limit of blur where disparities are up to `range` pixels out of focus:
// narrows the default, and refuses an aperture that the user chose.
Error FitAperture(double range, ApertureChoice* aperture);

// Prints to stderr which f-stop replaces the default, if one does.
void TellAperture(const std::string& path, const ApertureChoice& aperture);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_REFOCUS_APERTURE_H_

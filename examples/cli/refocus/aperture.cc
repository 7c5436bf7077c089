// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus/aperture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "examples/cli/input/notes.h"
#include "examples/command_line/options.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

// Stores the name and the value of the option that set the radius. --strength is stored only if
// neither --f-stop nor --aperture was given.
void NameOption(const ApertureOptions& options, ApertureChoice* aperture) {
  for (const auto& [name, value] : {std::pair{"--f-stop", options.f_stop},
                                    {"--aperture", options.aperture},
                                    {"--strength", options.strength}}) {
    if (!value) continue;
    aperture->option = name;
    aperture->value = Short(*value);
    return;
  }
}

// Returns the first number of three digits that satisfies `fits`. The search starts at `value` and
// increments or decrements the third digit. The function tests the number as printed, so that the
// number also fits if a user types it.
template <class Fits>
double FirstThatFits(double value, int direction, const Fits& fits) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  for (double count = std::round(value / unit) - direction;; count += direction) {
    const double printed = std::strtod(ThreeDigits(count * unit).c_str(), nullptr);
    if (fits(printed)) return printed;
  }
}

// Returns the widest f-stop of three digits within the blur limit. LargestRadius and
// LargestPercentage return the corresponding limits of --aperture and --strength.
double WidestFStop(double range, const ApertureChoice& aperture) {
  const double factor = aperture.widest * aperture.strength;
  return FirstThatFits(factor * range / STARFOCUS_MAX_BLUR, 1, [&](double f_stop) {
    return aperture.widest / f_stop * aperture.strength * range <= STARFOCUS_MAX_BLUR;
  });
}

double LargestRadius(double range, const ApertureChoice& aperture) {
  return FirstThatFits(STARFOCUS_MAX_BLUR / range / aperture.strength, -1, [&](double radius) {
    return radius * aperture.strength * range <= STARFOCUS_MAX_BLUR;
  });
}

double LargestPercentage(double range, const ApertureChoice& aperture) {
  const double base = aperture.radius / aperture.strength;
  return FirstThatFits(100 * STARFOCUS_MAX_BLUR / range / base, -1, [&](double percentage) {
    return base * (percentage / 100) * range <= STARFOCUS_MAX_BLUR;
  });
}

// Describes the largest aperture within the blur limit, as a value of the option that set the
// aperture.
std::string WhatFits(double range, const ApertureChoice& aperture) {
  if (aperture.option == "--f-stop") {
    return "f/" + ThreeDigits(WidestFStop(range, aperture)) + " or narrower";
  }
  return aperture.option == "--aperture"
             ? "at most " + ThreeDigits(LargestRadius(range, aperture))
             : "at most " + ThreeDigits(LargestPercentage(range, aperture)) + " percent";
}

}  // namespace

Result<ApertureChoice> PlanAperture(const ApertureOptions& options, const Capture& capture) {
  if (options.aperture && options.f_stop) {
    return Error::Usage("--f-stop", "either --aperture U or --f-stop N", "both");
  }
  if (options.widest && !options.f_stop) {
    return Error::Usage("--widest", "--f-stop N as well", "no --f-stop");
  }
  ApertureChoice aperture;
  if (capture.photo) {
    aperture.remedy =
        std::isfinite(capture.subject)
            ? "a wider aperture by --f-stop or --aperture changes this"
            : "another --depth-unit of a depth picture or a wider aperture changes this";
  }
  if (capture.widest > 0) aperture.widest = capture.widest;
  if (capture.f_stop > 0) aperture.radius = capture.widest / capture.f_stop;
  if (options.aperture) aperture.radius = *options.aperture;
  if (options.widest) aperture.widest = *options.widest;
  if (options.f_stop) aperture.radius = aperture.widest / *options.f_stop;
  if (options.f_stop && *options.f_stop < aperture.widest) {
    return Error::Usage("--f-stop", "an f-stop of at least the widest, " + Short(aperture.widest),
                        Short(*options.f_stop));
  }
  aperture.strength = options.strength.value_or(100) / 100;
  aperture.radius *= aperture.strength;
  NameOption(options, &aperture);
  return aperture;
}

double FarthestFromFocus(const starfocus_disparity_stats& stats, const std::vector<double>& foci,
                         const starfocus::Params& lens) {
  double range = 0;
  for (const double focus : foci) {
    range = std::max(
        {range, focus - lens.focus_farther - stats.min, stats.max - focus - lens.focus_nearer});
  }
  return range;
}

double SharpRadius(int width, int height) {
  return std::max(1.0, std::hypot(width, height) / 3000);
}

Error FitAperture(double range, ApertureChoice* aperture) {
  const double blur = aperture->radius * range;
  aperture->blur = std::min(blur, STARFOCUS_MAX_BLUR);
  if (blur <= STARFOCUS_MAX_BLUR) return {};
  if (aperture->option.empty()) {
    aperture->radius = aperture->widest / WidestFStop(range, *aperture);
    aperture->narrowed = true;
    return {};
  }
  return Error::Usage(
      aperture->option,
      WhatFits(range, *aperture) + " (a blur of at most " + Short(STARFOCUS_MAX_BLUR) + " pixels)",
      aperture->value + ", which blurs by " + Short(std::ceil(10 * blur) / 10) + " pixels");
}

void TellAperture(const std::string& path, const ApertureChoice& aperture) {
  if (!aperture.remedy.empty() && aperture.blur < 1 && aperture.radius > 0) {
    TellNote(path, "the blur is below a pixel everywhere, at most " + ThreeDigits(aperture.blur) +
                       " (" + aperture.remedy + ")");
  }
  if (!aperture.narrowed) return;
  TellNote(path, "aperture set to f/" + ThreeDigits(aperture.widest / aperture.radius) +
                     ", the widest with a blur of at most " + Short(STARFOCUS_MAX_BLUR) +
                     " pixels (--f-stop sets another)");
}

}  // namespace starfocus

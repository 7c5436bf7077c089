// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/shape.h"

#include <algorithm>
#include <vector>

#include "examples/command_line/options.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

constexpr double kPi = 3.14159265358979323846;

Error ShapeError(const std::string& text) {
  return Error::Usage(
      "--shape",
      "fall-off, disc, polygon:N[,ROTATION[,CURVATURE]] (N from 3 to 12, ROTATION from -360 "
      "to 360, CURVATURE from 0 to 1) or ring:INNER (0 to 0.9)",
      "'" + text.substr(0, 60) + "'");
}

bool SetPolygon(const std::vector<double>& numbers, starfocus_params* lens) {
  if (numbers.empty() || numbers.size() > 3) return false;
  const double blades = numbers[0], rotation = numbers.size() > 1 ? numbers[1] : 0;
  const double curvature = numbers.size() > 2 ? numbers[2] : 0;
  if (blades < STARFOCUS_MIN_BLADES || blades > STARFOCUS_MAX_BLADES || blades != int(blades))
    return false;
  if (rotation < -360 || rotation > 360 || curvature < 0 || curvature > 1) return false;
  lens->shape = STARFOCUS_SHAPE_POLYGON;
  lens->blades = static_cast<int32_t>(blades);
  lens->rotation = rotation;
  lens->curvature = curvature;
  return true;
}

bool SetRing(const std::vector<double>& numbers, starfocus_params* lens) {
  if (numbers.size() != 1 || numbers[0] < 0 || numbers[0] > STARFOCUS_MAX_RING_INNER) return false;
  lens->shape = STARFOCUS_SHAPE_RING;
  lens->ring_inner = numbers[0];
  return true;
}

bool SetShape(const std::string& text, starfocus_params* lens) {
  const size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  if (colon == std::string::npos) {
    lens->shape = name == "disc" ? STARFOCUS_SHAPE_DISC : STARFOCUS_SHAPE_FALL_OFF;
    return name == "disc" || name == "fall-off";
  }
  const std::vector<double> numbers = ReadNumbers(text.substr(colon + 1), ',');
  if (name == "polygon") return SetPolygon(numbers, lens);
  return name == "ring" && SetRing(numbers, lens);
}

}  // namespace

void AddShapeOptions(Command* command, ShapeOptions* options) {
  AddOptions(
      {
          {"--shape", "fall-off|disc|polygon:N[,ROTATION[,CURVATURE]]|ring:INNER",
           "Opening of the lens: fall-off darkens towards the rim (see --theta); disc is "
           "equally bright everywhere; polygon has N blades, 3 to 12, with a corner at "
           "the top, turned clockwise by ROTATION degrees, -360 to 360, and with edges "
           "rounded by CURVATURE, 0 to 1; ring is a disc with a hole of INNER times its "
           "radius, 0 to 0.9",
           &options->shape, Use::kDefault},
          {"--theta", "T", "Angle of the fall-off as a fraction of pi, 0.05 to 0.45",
           Number(0.05, 0.45, "a fraction of pi from 0.05 to 0.45", &options->theta),
           Use::kDefault},
          {"--cats-eye", "X",
           "Strength of cat's-eye vignetting: how far a second rim moves into the opening "
           "towards the corners, 0 to 1 radii",
           Number(0, 1, "a number from 0 to 1", &options->cats_eye), Use::kDefault},
      },
      command);
}

Result<starfocus::Params> ParseShape(const ShapeOptions& options) {
  starfocus::Params lens;
  if (!SetShape(options.shape, &lens)) return ShapeError(options.shape);
  if (lens.shape != STARFOCUS_SHAPE_FALL_OFF && options.theta != ShapeOptions().theta) {
    return Error::Usage("--theta", "--shape fall-off", "--shape " + options.shape);
  }
  // The library defines the exact values of the range and the default.
  lens.theta = std::clamp(options.theta * kPi, STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA);
  lens.cats_eye = options.cats_eye;
  return lens;
}

std::string ShapeSuffix(const ShapeOptions& options) {
  const ShapeOptions defaults;
  std::string suffix;
  if (options.shape != defaults.shape) suffix += "_" + options.shape;
  if (options.theta != defaults.theta) suffix += "_theta" + Short(options.theta);
  if (options.cats_eye != defaults.cats_eye) suffix += "_cats-eye" + Short(options.cats_eye);
  for (char& c : suffix) {
    if (c == ':' || c == ',') c = '-';
  }
  return suffix;
}

}  // namespace starfocus

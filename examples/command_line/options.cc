// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "platform/image.h"
#include "platform/text.h"
#include "starfocus/pool.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

const Words<starfocus_transfer> kTransfers = {{"srgb", STARFOCUS_TRANSFER_SRGB},
                                              {"none", STARFOCUS_TRANSFER_NONE}};

std::optional<int> ReadWhole(const std::string& text) {
  if (text.empty() || text.size() > 9) return {};
  if (text.find_first_not_of("0123456789") != std::string::npos) return {};
  return std::atoi(text.c_str());
}

// Parses a decimal number.
std::optional<double> ReadNumber(const std::string& text) {
  if (text.find_first_not_of("0123456789+-.eE") != std::string::npos) return {};
  return ParseNumber(text);
}

// Parses integers up to the largest picture size. Returns an empty list if any part is invalid.
std::vector<int> ReadSizes(const std::string& text, char separator) {
  std::vector<int> sizes;
  for (const std::string& part : Split(text, separator)) {
    const std::optional<int> size = ReadWhole(part);
    if (!size || *size > kMaxPictureSize) return {};
    sizes.push_back(*size);
  }
  return sizes;
}

template <class T>
Target ReadWholeInto(int low, int high, T* value, const std::string& shown) {
  const auto read = [low, high, value](const std::string& text) -> std::string {
    const std::optional<int> number = ReadWhole(text);
    if (!number || *number < low || *number > high) {
      return "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    }
    *value = *number;
    return "";
  };
  return Target(read, shown);
}

template <class T>
Target ReadNumberInto(double low, double high, const std::string& expected, T* value,
                      const std::string& shown) {
  const auto read = [low, high, expected, value](const std::string& text) -> std::string {
    const std::optional<double> number = ReadNumber(text);
    if (!number || *number < low || *number > high) return expected;
    *value = *number;
    return "";
  };
  return Target(read, shown);
}

template <class T>
Target ReadPairInto(char separator, T* value) {
  return Target([separator, value](const std::string& text) -> std::string {
    const std::vector<int> sizes = ReadSizes(text, separator);
    if (sizes.size() != 2) {
      return std::string("two whole numbers separated by '") + separator + "'";
    }
    *value = Pixel{sizes[0], sizes[1]};
    return "";
  });
}

bool IsFar(const starfocus_position& position) {
  return std::fabs(position.u) > 1 || std::fabs(position.v) > 1;
}

std::string ReadViews(const std::string& text, Positions* positions) {
  const std::optional<int> star = ReadWhole(text);
  if (star && IsStarSet(*star)) {
    *positions = StarPositions(*star);
    return "";
  }
  positions->clear();
  for (const std::string& part : Split(text, ':')) {
    const std::vector<double> numbers = ReadNumbers(part, ',');
    if (numbers.size() != 2) return "17, 9, 5 or 1, or positions U,V:U,V";
    const starfocus_position position = RoundedPosition(numbers[0], numbers[1]);
    if (IsFar(position)) return "positions from -1 to 1";
    for (const starfocus_position& other : *positions) {
      if (SamePosition(other, position)) return "different positions";
    }
    positions->push_back(position);
  }
  if (!SamePosition(positions->front(), {0, 0})) return "the centre view 0,0 first";
  if (positions->size() <= STARFOCUS_MAX_VIEWS) return "";
  return "at most " + std::to_string(STARFOCUS_MAX_VIEWS) + " views";
}

constexpr double kMost = std::numeric_limits<double>::max();

}  // namespace

Target Whole(int low, int high, int* value) {
  return ReadWholeInto(low, high, value, std::to_string(*value));
}

Target Whole(int low, int high, std::optional<int>* value) {
  return ReadWholeInto(low, high, value, "");
}

Target Threads(int* value) { return Whole(1, STARFOCUS_MAX_WORKERS, value); }

Option ThreadsOption(int* value) {
  *value = starfocus_pool_cores();
  return {"--threads", "N", kThreadsHelp, Threads(value)};
}

Target Number(double* value) { return Number(-kMost, kMost, "a finite number", value); }

Target Number(std::optional<double>* value) {
  return Number(-kMost, kMost, "a finite number", value);
}

Target Number(double low, double high, const std::string& expected, double* value) {
  return ReadNumberInto(low, high, expected, value, Short(*value));
}

Target Number(double low, double high, const std::string& expected, std::optional<double>* value) {
  return ReadNumberInto(low, high, expected, value, "");
}

Target Transfer(starfocus_transfer* value) { return Choice<starfocus_transfer>(kTransfers, value); }

Target Transfer(std::optional<starfocus_transfer>* value) {
  return Choice<starfocus_transfer>(kTransfers, value);
}

Target FStop(std::optional<double>* value) {
  return Target([value](const std::string& text) -> std::string {
    const size_t letter = !text.empty() && (text[0] == 'f' || text[0] == 'F') ? 1 : 0;
    const size_t slash = letter == 1 && text.size() > 1 && text[1] == '/' ? 1 : 0;
    const std::optional<double> number = ReadNumber(text.substr(letter + slash));
    if (!number || *number <= 0) return "an f-stop above 0, such as 2.8 or f/2.8";
    *value = *number;
    return "";
  });
}

Target Pair(char separator, Pixel* value) {
  Target target = ReadPairInto(separator, value);
  target.shown = std::to_string(value->x) + separator + std::to_string(value->y);
  return target;
}

Target Pair(char separator, std::optional<Pixel>* value) { return ReadPairInto(separator, value); }

Target Region(starfocus_region* value) {
  return Target([value](const std::string& text) -> std::string {
    const std::vector<int> sizes = ReadSizes(text, ',');
    if (sizes.size() != 4 || sizes[2] == 0 || sizes[3] == 0) {
      return "X,Y,W,H in whole pixels, with W and H above 0";
    }
    *value = {sizes[0], sizes[1], sizes[2], sizes[3]};
    return "";
  });
}

Target Views(Positions* positions) {
  return Target([positions](const std::string& text) { return ReadViews(text, positions); },
                positions->empty() ? "" : std::to_string(positions->size()));
}

std::vector<double> ReadNumbers(const std::string& text, char separator) {
  std::vector<double> numbers;
  for (const std::string& part : Split(text, separator)) {
    const std::optional<double> number = ReadNumber(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

std::string ThreeDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

std::string Decimal(double value, int decimals) {
  char text[400];  // The largest double has 309 digits.
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

std::string OneOf(const std::vector<std::string>& words) {
  std::string text = words[0];
  for (size_t i = 1; i < words.size(); ++i) {
    text += (i + 1 == words.size() ? " or " : ", ") + words[i];
  }
  return text;
}

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

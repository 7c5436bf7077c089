// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/input_options.h"

#include <cmath>

#include "examples/command_line/options.h"

namespace starfocus {
namespace {

constexpr int kMostSeconds = 86400;

// Parses "none" or a list of numbers separated by commas, of which one may be inf.
std::string ReadUnknown(const std::string& text, DepthOptions* options) {
  options->has_unknown = true;
  options->alpha = text == "none" ? Alpha::kIgnored : Alpha::kTransparent;
  if (text == "none") return "";
  std::string numbers = "," + text + ",";
  const size_t at = numbers.find(",inf,");
  if (at != std::string::npos) numbers.erase(at, 4);
  if (numbers != ",") options->unknown = ReadNumbers(numbers.substr(1, numbers.size() - 2), ',');
  if (options->unknown.empty() && numbers != ",") return "none, inf or a list of values V,V,...";
  if (at != std::string::npos) options->unknown.push_back(HUGE_VAL);
  return "";
}

// Parses the name of a unit, or a number of metres.
std::string ReadUnit(const std::string& text, DepthOptions* options) {
  if (text == "disparity" || text == "depth16") {
    options->unit = text == "depth16" ? DepthUnit::kDepth16 : DepthUnit::kDisparity;
    return "";
  }
  const std::vector<double> numbers = ReadNumbers(text == "m"    ? "1"
                                                  : text == "mm" ? "0.001"
                                                                 : text,
                                                  ',');
  if (numbers.size() != 1 || !(numbers[0] > 0)) {
    return "m, mm, a number of metres above 0, depth16 or disparity";
  }
  options->unit = DepthUnit::kDistance;
  options->metres = numbers[0];
  return "";
}

Target ReadCommand(PictureCommand* command) {
  return Target([command](const std::string& text) {
    command->line = text;
    return CheckPictureCommand(text);
  });
}

// Adds the options of the matte of a photo.
void AddMatteOptions(Command* command, InputOptions* options) {
  AddOptions(
      {
          {"--matte", "FILE",
           "Matte of the photo, of any size and in the formats of --depth: its alpha channel, or "
           "grey levels with white for the subject. Without depth, the photo becomes the subject "
           "and a background far behind it; with depth, the matte is the coverage of the outlines "
           "of the subject; default: the matte in the photo",
           &options->matte},
          {"--matte-command", "CMD",
           "Shell command that computes the matte of a photo without matte: it reads the PNG "
           "picture {input} and writes a matte to {output}; default: none",
           ReadCommand(&options->matte_command), Use::kOptional, "--matte"},
          {"--floor", nullptr,
           "For a photo with a matte and without depth: the background comes nearer from the "
           "middle of the subject or of the picture downwards, whichever is higher, and reaches "
           "the subject at its feet",
           &options->map.floor},
      },
      command);
}

// Adds the options for properties of a depth picture.
void AddDepthPictureOptions(Command* command, DepthOptions* options) {
  AddOptions(
      {
          {"--near", "white|black",
           "Shade that is near in a depth picture; default: white in a PFM file, "
           "otherwise guessed from the lower part of the picture",
           Choice<Near>({{"white", Near::kWhite}, {"black", Near::kBlack}}, &options->near)},
          {"--depth-unit", "m|mm|NUMBER|depth16|disparity",
           "Unit of the values of a depth picture: distances in metres (m), millimetres "
           "(mm) or multiples of a number of metres (0.0002 for maps that store 5000 for a "
           "metre), Android's DEPTH16, or disparities in pixels of the photo; default: no "
           "unit, so that only the order of the values matters",
           Target([options](const std::string& text) { return ReadUnit(text, options); })},
          {"--depth-orientation", "photo|upright",
           "Orientation of a depth picture or matte: photo rotates it by the photo's EXIF, "
           "upright does not; default: guessed from proportions and edges",
           Choice<DepthOrientation>(
               {{"photo", DepthOrientation::kPhoto}, {"upright", DepthOrientation::kUpright}},
               &options->orientation)},
          {"--unknown", "none|inf|V,V,...",
           "Values of a depth picture that mean an unknown depth, in addition to transparent "
           "pixels; none means that all finite values are known, also those of transparent "
           "pixels; default: values up to 0, and 65535 in pictures with more than 8 bits, "
           "unless the other values show that these are depths",
           Target([options](const std::string& text) { return ReadUnknown(text, options); })},
      },
      command);
}

}  // namespace

void AddInputOptions(Command* command, InputOptions* options, std::vector<std::string>* several) {
  AddOptions(
      {
          several == nullptr
              ? Option{"SRC", "DIR|PHOTO",
                       "Light-field folder, folder of views with another layout, or depth photo; "
                       "- reads a photo from standard input",
                       &options->path, Use::kRequired}
              : Option{"SRC", "DIR|PHOTO",
                       "One or more light-field folders, folders of views with another layout, or "
                       "depth photos; - reads a photo from standard input",
                       several, Use::kRequired},
          {"--depth", "FILE",
           "Depth picture of the photo (PNG, PGM, PPM, JPEG, WebP, PFM, TIFF, NPY or NPZ); "
           "default: "
           "the map in the photo, or the file NAME-depth, NAME_depth or NAME.depth in the "
           "folder of the photo",
           &options->depth},
          {"--depth-command", "CMD",
           "Shell command that estimates the depth of a photo without depth: it reads the "
           "PNG picture {input} and writes a depth picture to {output}; default: none",
           ReadCommand(&options->depth_command), Use::kOptional, "--depth"},
          {"--depth-timeout", "S",
           "Time limit of --depth-command and --matte-command in seconds, 1 to 86400",
           Whole(1, kMostSeconds, &options->seconds), Use::kDefault},
      },
      command);
  AddDepthPictureOptions(command, &options->map);
  AddMatteOptions(command, options);
  command->starts_programs = [options] { return RunsCommand(*options); };
}

void AddRightOption(Command* command, InputOptions* options) {
  AddOptions(
      {
          {"--right", "FILE",
           "Right picture of a stereo pair whose left picture is SRC; the disparities are "
           "estimated; default: none",
           &options->right},
      },
      command);
}

void AddCoverageOption(Command* command, InputOptions* options) {
  AddOptions(
      {
          {"--coverage", "FILE|none",
           "Picture of how much of each pixel the nearer surface covers, such as a "
           "matting network computes: its alpha channel, or grey levels with white for "
           "full coverage; none ignores coverage.png of a light-field folder and the coverage of "
           "the matte in a photo, which are the default",
           Target([options](const std::string& text) {
             options->ignores_coverage = text == "none";
             options->coverage = options->ignores_coverage ? "" : text;
             return std::string();
           })},
      },
      command);
}

void AddMapOptions(Command* command, MapOptions* options) {
  AddOptions(
      {
          {"--fill-invalid", nullptr,
           "Replace non-finite disparities by the nearest valid disparity", &options->fill},
          {"--repair", nullptr,
           "Repair the disparity map first, by the side views or, for a single view, by "
           "its colours: wrong and blurred edges, noise and unknown values; this is the "
           "default for depth photos",
           &options->repair},
          {"--no-repair", nullptr, "Use the map of a depth photo without repair",
           &options->no_repair, Use::kOptional, "--repair"},
      },
      command);
}

}  // namespace starfocus

// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/input_options.h"

#include "examples/command_line/options.h"

namespace starfocus {
namespace {

constexpr int kMostSeconds = 86400;

// Parses "none" or a list of numbers separated by commas.
std::string ReadUnknown(const std::string& text, DepthOptions* options) {
  options->has_unknown = true;
  options->use_alpha = text != "none";
  if (options->use_alpha) options->unknown = ReadNumbers(text, ',');
  return options->use_alpha && options->unknown.empty() ? "none or a list of values V,V,..." : "";
}

std::string ReadCommand(const std::string& text, DepthCommand* command) {
  command->command = text;
  return CheckDepthCommand(text);
}

// Adds the options for properties of a depth picture.
void AddDepthPictureOptions(Command* command, DepthOptions* options) {
  AddOptions(
      {
          {"--near", "white|black",
           "Shade that is near in a depth picture; default: white in a PFM file, "
           "otherwise guessed from the lower part of the picture",
           Choice<Near>({{"white", Near::kWhite}, {"black", Near::kBlack}}, &options->near)},
          {"--depth-unit", "m|mm|disparity",
           "Unit of the values of a depth picture: distances in metres (m) or millimetres "
           "(mm), or disparities in pixels of the photo; default: no unit, so that only "
           "the order of the values matters",
           Choice<DepthUnit>({{"m", DepthUnit::kMetres},
                              {"mm", DepthUnit::kMillimetres},
                              {"disparity", DepthUnit::kDisparity}},
                             &options->unit)},
          {"--depth-orientation", "photo|upright",
           "Orientation of a depth picture: photo rotates the depth picture by the "
           "photo's EXIF, upright does not; default: guessed from proportions and edges",
           Choice<DepthOrientation>(
               {{"photo", DepthOrientation::kPhoto}, {"upright", DepthOrientation::kUpright}},
               &options->orientation)},
          {"--unknown", "none|V,V,...",
           "Values of a depth picture that mean an unknown depth, in addition to transparent "
           "pixels; none means that all finite values are known, also those of transparent "
           "pixels; default: 0 and 65535 in pictures with more than 8 bits, unless the other "
           "values show that 0 and 65535 are depths",
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
           Target(
               [options](const std::string& text) { return ReadCommand(text, &options->command); }),
           Use::kOptional, "--depth"},
          {"--depth-timeout", "S", "Time limit of --depth-command in seconds, 1 to 86400",
           Whole(1, kMostSeconds, &options->command.seconds), Use::kDefault},
      },
      command);
  AddDepthPictureOptions(command, &options->map);
  command->starts_programs = [options] { return EstimatesDepth(*options); };
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
          {"--coverage", "FILE",
           "Picture of how much of each pixel the nearer surface covers, such as a "
           "matting network computes: its alpha channel, or grey levels with white for "
           "full coverage; default: coverage.png of a light-field folder, otherwise none",
           &options->coverage},
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

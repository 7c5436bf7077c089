// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input_options.h"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include "examples/command_line/options.h"
#include "platform/depth_file.h"
#include "platform/file.h"
#include "platform/folder.h"
#include "platform/helper/helper.h"
#include "platform/image_io.h"
#include "platform/pfm.h"
#include "platform/shell_command.h"

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
           "Unit of the values of a depth picture or of Z in an OpenEXR photo: distances in metres "
           "(m), millimetres "
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
           "Depth picture of the photo (PNG, PGM, PPM, JPEG, WebP, PFM, TIFF, OpenEXR, NPY or "
           "NPZ); default: the map in the photo, or the file NAME-depth, NAME_depth or NAME.depth "
           "in the folder of the photo",
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

namespace {

constexpr char kInput[] = "{input}", kOutput[] = "{output}";
constexpr char kInputName[] = "photo.png", kLogName[] = "log.txt";

void ReplaceAll(const std::string& part, const std::string& by, std::string* text) {
  for (size_t at = text->find(part); at != std::string::npos; at = text->find(part, at)) {
    text->replace(at, part.size(), by);
    at += by.size();
  }
}

// Returns the name of the picture in {output}. OpenCV and Pillow choose the format by the
// extension; numpy.save adds .npy.
std::string OutputName(const PictureCommand& command) { return std::string(command.kind) + ".png"; }

Error NoOutput(const std::string& where, const PictureCommand& command, const std::string& found) {
  return Expected(where, std::string("a ") + command.picture + " in the file {output}", found);
}

// Returns the path of the file that the command wrote: the file of the given name, or the only file
// whose name starts with the same stem.
Result<std::string> FindOutput(const std::string& where, const PictureCommand& command,
                               const std::string& folder) {
  const Result<std::vector<std::string>> names = ListFolder(folder);
  if (!names) return names.error();
  std::vector<std::string> found;
  for (const std::string& name : *names) {
    if (name == OutputName(command)) return folder + "/" + name;
    if (name.rfind(command.kind, 0) == 0) found.push_back(name);
  }
  if (found.size() == 1) return folder + "/" + found[0];
  return NoOutput(where, command,
                  found.empty() ? "no file after the command succeeded"
                                : std::to_string(found.size()) + " files, such as " + found[0] +
                                      " and " + found[1]);
}

}  // namespace

std::string CheckPictureCommand(const std::string& line) {
  const bool complete =
      line.find(kInput) != std::string::npos && line.find(kOutput) != std::string::npos;
  return complete ? "" : "a command with {input} and {output}";
}

Result<Samples> RunPictureCommand(const PictureCommand& command, const CommandInput& input) {
  const std::string kind = command.kind, where = input.name + " (" + kind + " command)";
  TemporaryFolder folder;
  if (Error error = folder.Create()) return error;
  const std::string beginning = folder.path() + "/", photo = beginning + kInputName;
  if (Error error = WriteImage(photo, input.photo)) return error;
  std::string line = command.line;
  ReplaceAll(kInput, ShellQuoted(photo), &line);
  ReplaceAll(kOutput, ShellQuoted(beginning + OutputName(command)), &line);
  if (Error error = RunShellCommand(where, line, input.seconds, beginning + kLogName)) {
    return error;
  }
  const Result<std::string> output = FindOutput(where, command, folder.path());
  if (!output) return output.error();
  std::error_code ignored;
  if (std::filesystem::is_directory(*output, ignored)) return NoOutput(where, command, "a folder");
  if (CheckPlainFile(*output)) return NoOutput(where, command, "a device or pipe");
  const Result<Bytes> bytes = ReadFile(*output);
  if (!bytes) return bytes.error();
  const std::string result = input.name + " (" + command.picture + " of the " + kind + " command)";
  return Confined<Samples>(result, [&] { return DecodeDepthFile(result, input.alpha, *bytes); });
}

Result<Samples> KeptPictures::Of(const PictureCommand& command, const CommandInput& input) {
  const std::pair<std::string, std::string> key = {input.name, command.kind};
  const auto found = kept_.find(key);
  if (found != kept_.end()) {
    Samples samples = found->second.rest;
    if (Error error = ReadPfm(found->second.path).MoveTo(&samples.map)) return error;
    return samples;
  }
  Result<Samples> samples = RunPictureCommand(command, input);
  if (!samples) return samples;
  if (Error error = folder_.path().empty() ? folder_.Create() : Error()) return error;
  const std::string path = folder_.path() + "/" + std::to_string(kept_.size()) + ".pfm";
  if (Error error = WritePfm(path, samples->map)) return error;
  FloatMap map = std::move(samples->map);
  samples->map = {};
  kept_[key] = {path, *samples};
  samples->map = std::move(map);
  return samples;
}

}  // namespace starfocus

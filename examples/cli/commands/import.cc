// SPDX-License-Identifier: Apache-2.0
// starfocus import: converts an input of any supported format to a light-field folder.
#include <filesystem>
#include <memory>

#include "examples/cli/commands.h"
#include "examples/cli/input.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "platform/console.h"
#include "platform/helper/decoder_threads.h"
#include "platform/light_field.h"
#include "platform/runner.h"
#include "platform/text.h"

namespace starfocus {
namespace {

struct ImportOptions {
  InputOptions input;
  MapOptions map;
  std::string folder;
  Positions views;
  int threads = 1;
  bool json = false;
};

// Rejects folders that already contain light-field files, because old and new files would mix.
Error CheckFolder(const std::string& folder) {
  const std::vector<std::string> files = LightFieldFiles(folder);
  return files.empty() ? Error() : Expected(folder, "a folder without a light field", files[0]);
}

// Prints notes about what the light field does not keep of the input. Its views keep the bits, the
// alpha and the colours of deep pictures.
void TellDropped(const Capture& capture) {
  const LightField& light_field = capture.light_field;
  const Metadata& metadata = capture.metadata;
  const bool is_deep = !light_field.deep.empty();
  const bool has_colours =
      !metadata.icc.empty() || !IsSrgb(metadata.colours) || light_field.is_linear;
  if (has_colours && !(is_deep && !light_field.deep_colours.form.empty())) {
    TellNote(capture.path,
             "the light field does not keep the colour profile, and its views count as "
             "sRGB (refocus and video read the photo itself, with its colours)");
  }
  if (!capture.gain_map.levels.empty()) {
    TellNote(capture.path, "the light field does not keep the gain map");
  }
  if (!is_deep) TellLost(capture);
}

void Tell(const ImportOptions& options, const Capture& capture) {
  if (options.json) {
    PrintLine(Describe(capture).Text());
    return;
  }
  const LightField& light_field = capture.light_field;
  PrintLine(capture.path + ": " + capture.format);
  for (const auto& fact : FactsOf(capture)) PrintLine("  " + fact.first + ": " + fact.second);
  const Image& view = light_field.views[0];
  PrintLine(options.folder + ": " + std::to_string(light_field.views.size()) +
            (light_field.views.size() == 1 ? " view of " : " views of ") +
            SizeText(view.width, view.height) + ", " +
            (light_field.disparity.values.empty()
                 ? "without a map (starfocus disparity estimates one)"
                 : "with a map"));
  if (capture.widest > 0) {
    PrintLine("for f-stops, refocus this light field with --widest " + Short(capture.widest));
  }
}

Error Run(const ImportOptions& options) {
  SetDecoderThreads(options.threads);
  if (Error error = CheckFolderApart({"DIR", options.folder}, {options.input.path})) return error;
  if (Error error = CheckFolderOutput({"DIR", options.folder})) return error;
  if (Error error = CheckFolder(options.folder)) return error;
  Result<Capture> opened = ReadInput(options.input);
  if (!opened) return opened.error();
  Capture& capture = *opened;
  TellNotes(capture);
  ThreadRunner runner(options.threads);
  if (Error error = LoadCapture(options.views, &capture, &runner)) return error;
  TellDropped(capture);
  if (Error error = CareForMap(options.map, options.threads, &capture)) return error;
  if (Error error = SaveLightField(options.folder, capture.light_field, &runner)) return error;
  Tell(options, capture);
  return {};
}

}  // namespace

Command ImportCommand() {
  const auto options = std::make_shared<ImportOptions>();
  Command command = {"import",
                     "Write a light-field folder from a photo or from other views",
                     {},
                     [options] { return Run(*options); },
                     {"starfocus import photo.jpg lf",
                      "starfocus import photo.png lf --depth depth.png --near white"},
                     "",
                     {{"Input and output",
                       {{"SRC", "Photo with depth, or views with another layout"},
                        {"DIR", "Light-field folder to write"},
                        {"--json", "Print the properties of the input as JSON"}}},
                      {"Depth",
                       {{"--depth", "Depth picture of the photo, if it is separate"},
                        {"--near", "Shade that is near in the depth picture"},
                        {"--depth-unit", "Unit of the values of the depth picture"},
                        {"--matte", "Matte of the subject, for a photo without depth"},
                        {"--no-repair", "Keep the map as it is in the photo"}}}}};
  AddInputOptions(&command, &options->input);
  AddRightOption(&command, &options->input);
  AddCoverageOption(&command, &options->input);
  AddOptions(
      {
          {"DIR", "DIR", "Light-field folder to write; it must not contain a light field",
           &options->folder, Use::kRequired},
      },
      &command);
  AddMapOptions(&command, &options->map);
  AddOptions(
      {
          {"--views", "17|9|5|1|U,V:U,V",
           "Views to write: the star of 17, 9, 5 or 1 views, or positions U,V:U,V from -1 "
           "to 1 that begin with 0,0; default: all views of the input",
           Views(&options->views)},
          ThreadsOption(&options->threads),
          {"--json", nullptr,
           "Print the format, the facts, the size and the views of the input as JSON instead of "
           "text",
           &options->json},
      },
      &command);
  return command;
}

}  // namespace starfocus

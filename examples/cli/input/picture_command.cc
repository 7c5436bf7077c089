// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/picture_command.h"

#include <filesystem>
#include <system_error>
#include <vector>

#include "platform/depth_file.h"
#include "platform/file.h"
#include "platform/folder.h"
#include "platform/helper/helper.h"
#include "platform/image_io.h"
#include "platform/pfm.h"
#include "platform/shell_command.h"

namespace starfocus {
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

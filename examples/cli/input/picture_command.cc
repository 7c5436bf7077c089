// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/picture_command.h"

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
// Part of the name of the depth picture before its extension, and the name that the command
// receives. OpenCV and Pillow choose the format by the extension; numpy.save adds .npy.
constexpr char kOutputStem[] = "depth", kOutputName[] = "depth.png";

void ReplaceAll(const std::string& part, const std::string& by, std::string* text) {
  for (size_t at = text->find(part); at != std::string::npos; at = text->find(part, at)) {
    text->replace(at, part.size(), by);
    at += by.size();
  }
}

// Returns the path of the file that the command wrote: the file of the given name, or the only file
// whose name starts with the same stem.
Result<std::string> FindOutput(const std::string& where, const std::string& folder) {
  const Result<std::vector<std::string>> names = ListFolder(folder);
  if (!names) return names.error();
  std::vector<std::string> found;
  for (const std::string& name : *names) {
    if (name == kOutputName) return folder + "/" + name;
    if (name.rfind(kOutputStem, 0) == 0) found.push_back(name);
  }
  if (found.size() == 1) return folder + "/" + found[0];
  return Expected(where, "a depth picture in the file {output}",
                  found.empty() ? "no file after the command succeeded"
                                : std::to_string(found.size()) + " files, such as " + found[0] +
                                      " and " + found[1]);
}

}  // namespace

std::string CheckDepthCommand(const std::string& text) {
  const bool complete =
      text.find(kInput) != std::string::npos && text.find(kOutput) != std::string::npos;
  return complete ? "" : "a command with {input} and {output}";
}

Result<Samples> RunDepthCommand(const std::string& name, const DepthCommand& command, Alpha alpha,
                                const Image& photo) {
  const std::string where = name + " (depth command)";
  TemporaryFolder folder;
  if (Error error = folder.Create()) return error;
  const std::string beginning = folder.path() + "/", input = beginning + kInputName;
  if (Error error = WriteImage(input, photo)) return error;
  std::string line = command.command;
  ReplaceAll(kInput, ShellQuoted(input), &line);
  ReplaceAll(kOutput, ShellQuoted(beginning + kOutputName), &line);
  if (Error error = RunShellCommand(where, line, command.seconds, beginning + kLogName)) {
    return error;
  }
  const Result<std::string> output = FindOutput(where, folder.path());
  if (!output) return output.error();
  if (CheckPlainFile(*output)) {
    return Expected(where, "a depth picture in the file {output}", "a device or pipe");
  }
  const Result<Bytes> bytes = ReadFile(*output);
  if (!bytes) return bytes.error();
  const std::string result = name + " (depth picture of the depth command)";
  return Confined<Samples>(result, [&] { return DecodeDepthFile(result, alpha, *bytes); });
}

Result<Samples> KeptEstimates::Of(const std::string& name, const DepthCommand& command, Alpha alpha,
                                  const Image& photo) {
  const auto found = kept_.find(name);
  if (found != kept_.end()) {
    Samples samples;
    samples.largest = found->second.largest;
    samples.larger_is_nearer = found->second.larger_is_nearer;
    if (Error error = ReadPfm(found->second.path).MoveTo(&samples.map)) return error;
    return samples;
  }
  Result<Samples> samples = RunDepthCommand(name, command, alpha, photo);
  if (!samples) return samples;
  if (Error error = folder_.path().empty() ? folder_.Create() : Error()) return error;
  const std::string path = folder_.path() + "/" + std::to_string(kept_.size()) + ".pfm";
  if (Error error = WritePfm(path, samples->map)) return error;
  kept_[name] = {path, samples->largest, samples->larger_is_nearer};
  return samples;
}

}  // namespace starfocus

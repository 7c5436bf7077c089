// SPDX-License-Identifier: Apache-2.0
// Code that the main functions of all programs share, and the check of all output files of a
// command before the command starts to work.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_

#include <functional>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Returns the line of --version: name, version of the library, and SIMD target.
std::string VersionText(const std::string& name);

// Runs a program and returns its exit code. Prints an error as one line to stderr, "<name>:
// <line>". Exceptions and failures to write to stdout are reported as errors. A closed pipe does
// not end the program. Signals that end the program leave no temporary files.
int RunProgram(const char* name, const std::function<Error()>& run);

struct OutputPath {
  std::string option, path;
};

// Inputs of a command, which its outputs must not overwrite.
struct Inputs {
  std::vector<std::string> folders = {};  // Light-field folders.
  std::vector<std::string> files = {};    // Other files; an empty name is ignored.
  std::vector<std::string> grids = {};    // Folders in which every picture is treated as a view.
};

// Returns an error if two outputs are the same file, or if an output is the same file as an input.
// Different names of one file, including links, are recognized.
Error CheckApart(const std::vector<OutputPath>& outputs, const Inputs& inputs);

// Returns an error if the output folder is one of the input folders, under any name or link. In an
// input folder, output files would mix with the views.
Error CheckFolderApart(const OutputPath& output, const std::vector<std::string>& folders);

// Returns true if the extension of a path is that of a video that starfocus does not write, or of a
// GIF file.
bool IsVideoName(const std::string& path);

enum class OutputKind { kPage, kJson, kFolder, kVideo, kOther };

// Returns an error if the extension of a page, a JSON file or a folder states another kind. Other
// extensions, and names without extension, fit every kind. The error for a video contains the
// command of ffmpeg that makes the video. A folder may have any name that ends with "/".
Error CheckKind(const OutputPath& output, OutputKind written);

// Calls CheckKind and CheckOutputPath.
Error CheckTextOutput(const OutputPath& output, OutputKind written);

// Returns an error unless the folder can be created, or exists and is writable, and CheckKind
// accepts its name.
Error CheckFolderOutput(const OutputPath& output);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_

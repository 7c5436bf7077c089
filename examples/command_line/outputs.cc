// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/outputs.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "platform/file.h"
#include "platform/light_field.h"
#include "platform/standard_stream.h"
#include "platform/writers/picture.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

// Returns a unique name for a file, whether or not the file exists.
fs::path NameOf(const fs::path& path) {
  std::error_code ignored;
  const fs::path name = fs::weakly_canonical(FollowLinks(fs::absolute(path)), ignored);
  return name.has_filename() ? name : name.parent_path();  // "folder/"
}

using FileId = std::pair<dev_t, ino_t>;

// Returns a value that all names of a file have in common, for example hard links. `stream` is the
// descriptor that the path "-" stands for. Returns nullopt if the file does not exist, or if it is
// neither a regular file nor a folder.
std::optional<FileId> IdOf(const std::string& path, int stream) {
  struct stat info = {};
  const int failed = IsStandardStream(path) ? fstat(stream, &info) : stat(path.c_str(), &info);
  if (failed != 0 || !(S_ISREG(info.st_mode) || S_ISDIR(info.st_mode))) return {};
  return FileId{info.st_dev, info.st_ino};
}

// Returns the files of a light-field folder that are symbolic links.
std::vector<std::string> FindLinks(const std::string& folder) {
  std::vector<std::string> links;
  std::error_code ignored;
  for (const std::string& path : LightFieldFiles(folder)) {
    if (fs::is_symlink(path, ignored)) links.push_back(path);
  }
  return links;
}

}  // namespace

Error CheckApart(const std::vector<Output>& outputs, const Inputs& inputs) {
  std::set<fs::path> folders, files, grids, names;
  // `ids` are those of inputs. Two names of one file are written one after the other by renaming,
  // but a file that is standard output would be lost if one of its names were written as well.
  std::set<std::optional<FileId>> ids, written, streamed;
  for (const std::string& folder : inputs.grids) grids.insert(NameOf(folder));
  for (const std::string& folder : inputs.folders) {
    folders.insert(NameOf(folder));
    for (const std::string& path : FindLinks(folder)) files.insert(NameOf(path));
  }
  for (const std::string& path : inputs.files) {
    if (path.empty()) continue;
    files.insert(NameOf(path));
    ids.insert(IdOf(path, STDIN_FILENO));
  }
  for (const Output& output : outputs) {
    // All names of standard output refer to the same stream. Standard input is a different stream.
    const bool stream = IsStandardStream(output.path);
    const fs::path name = stream ? "-" : NameOf(output.path);
    const std::optional<FileId> id = IdOf(output.path, STDOUT_FILENO);
    if (!names.insert(name).second || (id && (stream ? written : streamed).count(id) != 0)) {
      return Error::Usage(output.option, "a separate file",
                          output.path + ", which another output uses");
    }
    (stream ? streamed : written).insert(id);
    if ((id && ids.count(id) != 0) || files.count(name) != 0) {
      return Error::Usage(output.option, "a separate file", output.path + ", which is an input");
    }
    const bool beside_views =
        folders.count(name.parent_path()) != 0 || grids.count(name.parent_path()) != 0;
    if (beside_views && (name.filename() == "calib.txt" || name.filename() == "parameters.cfg")) {
      return Error::Usage(output.option, "a separate file", output.path + ", which is an input");
    }
    if (folders.count(name.parent_path()) != 0 && IsLightFieldFile(name.filename().string())) {
      return Error::Usage(output.option, "a separate file",
                          output.path + ", a file of the light field");
    }
    if (grids.count(name.parent_path()) != 0 && IsPictureExtension(FormatExtension(output.path))) {
      return Error::Usage(output.option, "a file outside the folder of views",
                          output.path + ", which would be read as a view");
    }
  }
  return {};
}

Error CheckFolderApart(const Output& output, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (NameOf(folder) != NameOf(output.path)) continue;
    return Error::Usage(output.option, "a separate folder",
                        output.path + ", which is an input light field");
  }
  return {};
}

Error CheckFolderOutput(const std::string& folder) {
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) {
    return Cannot("create folder", folder, "a file of that name exists");
  }
  fs::path at = NameOf(folder);
  while (at.has_relative_path() && !fs::exists(at, ignored)) at = at.parent_path();
  if (!fs::is_directory(at, ignored)) {
    return Cannot("create folder", folder, at.string() + " is not a folder");
  }
  if (access(at.c_str(), W_OK | X_OK) == 0) return {};
  const std::error_code reason(errno, std::generic_category());
  return Cannot(fs::is_directory(folder, ignored) ? "write into folder" : "create folder", folder,
                reason);
}

}  // namespace starfocus

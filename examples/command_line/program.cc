// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/program.h"

#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "platform/console.h"
#include "platform/file.h"
#include "platform/helper/helper.h"
#include "platform/light_field.h"
#include "platform/shell_command.h"
#include "platform/signal_cleanup.h"
#include "platform/standard_stream.h"
#include "platform/writers/picture.h"
#include "starfocus/starfocus.h"

namespace starfocus {

namespace {

// Returns true if no process reads the pipe of stdout any more, for example after `| head`.
bool IsReaderGone() {
  pollfd output = {STDOUT_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

// Flushes stdout. Returns an error if printed text could not be written. If the reader of a pipe is
// gone, ends the program without a message, as the signal does in programs that do not ignore it.
Error CheckPrinted() {
  const bool failed = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed) return {};
  if (errno == EPIPE || IsReaderGone()) {
    signal(SIGPIPE, SIG_DFL);
    raise(SIGPIPE);
  }
  const int reason = errno != 0 ? errno : EIO;
  return Cannot("write to", "standard output", {reason, std::generic_category()});
}

// Exit codes. Internal errors use the code EX_SOFTWARE of sysexits.h.
constexpr int kFailed = 1, kUsage = 2, kInternal = 70;

int Report(const char* name, const Error& error) {
  if (!error) return 0;
  if (!error.line().empty()) TellLine(std::string(name) + ": " + error.line());
  return error.kind() == ErrorKind::kInput   ? kFailed
         : error.kind() == ErrorKind::kUsage ? kUsage
                                             : kInternal;
}

}  // namespace

std::string VersionText(const std::string& name) {
  return name + " " + starfocus_version(nullptr) + " (" + starfocus_simd_target() + ")";
}

int RunProgram(const char* name, const std::function<Error()>& run) {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);  // writing beyond a limit of file sizes then fails with an error
  signal(SIGCHLD, SIG_DFL);  // if the parent ignores it, the ends of child processes are lost
  SignalCleanup::Install();
  ConfineDecoders();
  try {
    Error error = run();
    if (!error) error = CheckPrinted();
    return Report(name, error);
  } catch (const std::bad_alloc&) {
    // This handler must not allocate memory, because memory has run out.
    std::fprintf(stderr, "%s: out of memory\n", name);
    return kFailed;
  } catch (const std::exception& exception) {
    return Report(name, Error::Internal("program", "no internal error", exception.what()));
  }
}

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

// Extensions of files whose kind is known. GIF files are listed with the videos, because starfocus
// does not write them. A text file may contain JSON.
constexpr const char* kVideos[] = {".mp4", ".m4v",  ".mov", ".mkv", ".webm", ".avi", ".gif",
                                   ".mpg", ".mpeg", ".wmv", ".flv", ".ogv",  ".3gp", ".mts"};
constexpr const char* kPages[] = {".html", ".htm", ".xhtml"};
constexpr const char* kTexts[] = {".json", ".txt"};
constexpr const char* kOthers[] = {
    ".png",  ".ppm", ".jpg", ".jpeg", ".webp", ".bmp",  ".tif", ".tiff", ".pgm", ".heic", ".heif",
    ".avif", ".jxl", ".exr", ".svg",  ".mpo",  ".pfm",  ".npy", ".npz",  ".pdf", ".ps",   ".doc",
    ".docx", ".odt", ".md",  ".csv",  ".xml",  ".yaml", ".zip", ".tar",  ".gz"};

// Returns nullopt for an unknown extension.
std::optional<OutputKind> KindOf(const std::string& extension) {
  const auto has = [&](const auto& list) {
    return std::find(std::begin(list), std::end(list), extension) != std::end(list);
  };
  if (has(kVideos)) return OutputKind::kVideo;
  if (has(kPages)) return OutputKind::kPage;
  if (has(kTexts)) return OutputKind::kJson;
  return has(kOthers) ? std::optional<OutputKind>(OutputKind::kOther) : std::nullopt;
}

std::string Describe(OutputKind written) {
  return written == OutputKind::kPage   ? "a name for a web page (.html)"
         : written == OutputKind::kJson ? "a name for a JSON file (.json)"
                                        : "a folder for the pictures";
}

}  // namespace

Error CheckApart(const std::vector<OutputPath>& outputs, const Inputs& inputs) {
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
  for (const OutputPath& output : outputs) {
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

Error CheckFolderApart(const OutputPath& output, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (NameOf(folder) != NameOf(output.path)) continue;
    return Error::Usage(output.option, "a separate folder",
                        output.path + ", which is an input folder");
  }
  return {};
}

bool IsVideoName(const std::string& path) {
  return !path.empty() && path.back() != '/' && KindOf(LowerExtension(path)) == OutputKind::kVideo;
}

Error CheckKind(const OutputPath& output, OutputKind written) {
  const std::string& path = output.path;
  if (written == OutputKind::kFolder && IsStandardStream(path)) {
    return Error::Usage(output.option, Describe(written), path + " (standard output)");
  }
  if (IsStandardStream(path) || path.empty() || path.back() == '/') return {};
  const std::string extension = LowerExtension(path);
  const std::optional<OutputKind> kind = KindOf(extension);
  if (!kind || kind == written) return {};
  std::error_code ignored;
  if (written == OutputKind::kFolder && fs::is_directory(path, ignored)) {
    return Cannot("write", path,
                  "it is a folder with the extension of a file (" + path + "/ writes into it)");
  }
  std::string expected = Describe(written);
  if (written == OutputKind::kFolder && kind == OutputKind::kVideo) {
    const std::string folder = fs::path(path).replace_extension().string();
    expected += ", such as " + folder + ", from which this command makes the video: (cd " +
                ShellQuoted(folder) +
                " && cat $(ls -v *.png)) | ffmpeg -f image2pipe -framerate 30 -i - ";
    if (extension != ".gif") {
      expected += "-vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p ";
    }
    expected += ShellQuoted(path);
  }
  return Error::Usage(output.option, expected, path);
}

Error CheckTextOutput(const OutputPath& output, OutputKind written) {
  const Error error = CheckKind(output, written);
  return error ? error : CheckOutputPath(output.path);
}

Error CheckFolderOutput(const OutputPath& output) {
  const std::string& folder = output.path;
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) {
    return Cannot("create folder", folder, "a file of that name exists");
  }
  if (Error error = CheckKind(output, OutputKind::kFolder)) return error;
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

// SPDX-License-Identifier: Apache-2.0
#include "platform/file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "platform/standard_stream.h"
#include "platform/temporary_file.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string Reason(int error) { return std::generic_category().message(error); }

bool IsSpecial(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path FolderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Renaming onto a link would replace the link instead of what it points to.
fs::path FollowLink(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real;
}

// Empty, or the reason why the existing file must not be replaced.
std::string WhyProtected(const fs::path& target) {
  struct stat status;
  if (stat(target.c_str(), &status) != 0) return "";
  // Root may write to every file; one that nobody may write to is meant to stay.
  const bool writable = (status.st_mode & 0222) != 0 && access(target.c_str(), W_OK) == 0;
  return writable ? "" : "a read-only one";
}

// Gives the new file the owner and permissions of the one that it will replace.
std::string TakeStatus(const fs::path& target, std::FILE* file) {
  struct stat old, own;
  if (stat(target.c_str(), &old) != 0) return "";
  const int handle = fileno(file);
  if (fstat(handle, &own) != 0) return Reason(errno);
  const bool foreign = own.st_uid != old.st_uid || own.st_gid != old.st_gid;
  if (foreign && fchown(handle, old.st_uid, old.st_gid) != 0) return Reason(errno);
  return fchmod(handle, old.st_mode & 07777) == 0 ? "" : Reason(errno);
}

bool WriteAll(const Bytes& bytes, std::FILE* file) {
  return bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
}

// A device or pipe has no other file to be replaced by.
std::string WriteInPlace(const std::string& path, const Bytes& bytes) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file || !WriteAll(bytes, file.get())) return Reason(errno);
  return std::fclose(file.release()) == 0 ? "" : Reason(errno);
}

std::string Replace(const fs::path& target, const Bytes& bytes) {
  std::string reason = WhyProtected(target);
  if (!reason.empty()) return reason;
  TemporaryFile temporary(FolderOf(target).string());
  if (temporary.file() == nullptr) return Reason(errno);
  reason = TakeStatus(target, temporary.file());
  if (!reason.empty()) return reason;
  const bool whole = WriteAll(bytes, temporary.file()) && temporary.MoveTo(target.string());
  return whole ? "" : Reason(errno);
}

}  // namespace

std::string Expected(const std::string& where, const std::string& expected,
                     const std::string& found) {
  std::string line = where + ": expected " + expected + ", found " + found;
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return line;
}

std::string OutOfMemory(const std::string& where, const std::string& purpose) {
  return Expected(where, "enough memory to " + purpose, "too little (out of memory)");
}

std::string ReadFile(const std::string& path, Bytes* bytes) {
  bytes->clear();
  // Standard input is read by a handle of its own, which may be closed.
  File file(path == "-" ? fdopen(dup(STDIN_FILENO), "rb") : std::fopen(path.c_str(), "rb"));
  if (!file) return Expected(path, "a readable file", Reason(errno));
  struct stat status;
  if (fstat(fileno(file.get()), &status) == 0 && S_ISREG(status.st_mode)) {
    bytes->reserve(static_cast<size_t>(status.st_size));
  }
  uint8_t buffer[65536];
  for (;;) {
    const size_t got = std::fread(buffer, 1, sizeof(buffer), file.get());
    bytes->insert(bytes->end(), buffer, buffer + got);
    if (got < sizeof(buffer)) break;
  }
  if (std::ferror(file.get())) return Expected(path, "a readable file", Reason(errno));
  return "";
}

std::string WriteFile(const std::string& path, const Bytes& bytes) {
  if (IsStandardStream(path)) {
    const bool whole = WriteAll(bytes, stdout) && std::fflush(stdout) == 0;
    return whole ? "" : Expected("standard output", "room for " + path, Reason(errno));
  }
  const fs::path target = FollowLink(path);
  const std::string reason = IsSpecial(target) ? WriteInPlace(path, bytes) : Replace(target, bytes);
  return reason.empty() ? "" : Expected(path, "a writable file", reason);
}

std::string CheckPlainFile(const std::string& path) {
  return IsSpecial(path) ? Expected(path, "a file", "a device or pipe") : "";
}

std::string CheckOutputPath(const std::string& path) {
  std::error_code error;
  if (path.empty()) return Expected("output", "a file name", "an empty one");
  if (IsStandardStream(path)) return "";
  if (fs::is_directory(path, error)) return Expected(path, "a file name", "a folder");
  const fs::path folder = FolderOf(FollowLink(path));
  if (!fs::is_directory(folder, error)) {
    return Expected(path, "an existing folder", "no folder " + folder.string());
  }
  struct stat status;
  if (stat(path.c_str(), &status) != 0 && errno != ENOENT) {
    return Expected(path, "a name for a file", Reason(errno));
  }
  if (IsSpecial(path)) return "";
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    return Expected(path, "a folder that can be written into", Reason(errno));
  }
  const std::string reason = WhyProtected(path);
  return reason.empty() ? "" : Expected(path, "a writable file", reason);
}

std::string LowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace starfocus

// SPDX-License-Identifier: Apache-2.0
#include "platform/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "platform/standard_stream.h"
#include "platform/temporary_file.h"
#include "platform/text.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::error_code Reason(int error) { return {error, std::generic_category()}; }

bool IsSpecial(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

constexpr char kSpecial[] = "it is a device or pipe";

fs::path FolderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Returns true if the file has no write permission at all, or if this process lacks the permission
// to write to the file. The check of the permission bits protects read-only files even from root,
// for whom access() always succeeds.
bool IsProtected(const fs::path& target) {
  struct stat status;
  if (stat(target.c_str(), &status) != 0) return false;
  return (status.st_mode & 0222) == 0 || access(target.c_str(), W_OK) != 0;
}

Error ReadOnly(const std::string& path) { return Cannot("write", path, "the file is read-only"); }

// Gives the new file `file` the owner and permissions of the file `target`, which the new file will
// replace. Returns false and sets errno on failure.
bool TakeStatus(const fs::path& target, std::FILE* file) {
  struct stat old, own;
  if (stat(target.c_str(), &old) != 0) return true;
  const int handle = fileno(file);
  if (fstat(handle, &own) != 0) return false;
  const bool foreign = own.st_uid != old.st_uid || own.st_gid != old.st_gid;
  if (foreign && fchown(handle, old.st_uid, old.st_gid) != 0) return false;
  return fchmod(handle, old.st_mode & 07777) == 0;
}

bool WriteAll(const Bytes& bytes, std::FILE* file) {
  return bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
}

// Writes to a device or pipe, which cannot be replaced by renaming.
Error WriteInPlace(const std::string& path, const Bytes& bytes) {
  File file(std::fopen(path.c_str(), "wb"));
  const bool whole = file && WriteAll(bytes, file.get()) && std::fclose(file.release()) == 0;
  return whole ? Error() : Cannot("write", path, Reason(errno));
}

Error Replace(const std::string& path, const fs::path& target, const Bytes& bytes) {
  if (IsProtected(target)) return ReadOnly(path);
  TemporaryFile temporary(FolderOf(target).string());
  const bool whole = temporary.file() != nullptr && TakeStatus(target, temporary.file()) &&
                     WriteAll(bytes, temporary.file()) && temporary.MoveTo(target.string());
  return whole ? Error() : Cannot("write", path, Reason(errno));
}

// Limit on the size of an input file in bytes. A PPM file of the largest supported picture, 2^28
// pixels with 16 bits per sample, is smaller than kMostBytes. A limit is required because a pipe
// has no known size and may be endless.
constexpr uint64_t kMostBytes = uint64_t{1} << 31;

Error TooLarge(const std::string& path, uint64_t most, const std::string& found) {
  return {ErrorKind::kInput, path + ": the file is too large (expected at most " +
                                 std::to_string(most) + " bytes, found " + found + ")"};
}

struct OpenedFile {
  File file;
  size_t size = 0;  // size in bytes; 0 for a pipe
};

// Opens a regular file of at most `most` bytes, or standard input of any kind. Opening a pipe
// without O_NONBLOCK would wait for a writer.
Result<OpenedFile> OpenFile(const std::string& path, uint64_t most) {
  // Duplicate the descriptor of standard input, because File closes its descriptor.
  const bool standard = path == "-";
  const int handle =
      standard ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0 && IsSpecial(path)) return Cannot("read", path, kSpecial);
  File file(handle < 0 ? nullptr : fdopen(handle, "rb"));
  struct stat status;
  if (file == nullptr || fstat(handle, &status) != 0) return Cannot("read", path, Reason(errno));
  if (S_ISDIR(status.st_mode)) return Cannot("read", path, "it is a folder");
  if (!S_ISREG(status.st_mode)) {
    if (!standard) return Cannot("read", path, kSpecial);
    return OpenedFile{std::move(file), 0};
  }
  const auto bytes = static_cast<uint64_t>(status.st_size);
  if (bytes > most) return TooLarge(path, most, std::to_string(bytes));
  return OpenedFile{std::move(file), static_cast<size_t>(bytes)};
}

using IsWanted = bool (*)(const Bytes& beginning);

// Reads a file of at most `most` bytes. If `is_wanted` is not null and returns false for the first
// 64 KiB, returns only these bytes.
Result<Bytes> ReadAtMost(const std::string& path, uint64_t most, IsWanted is_wanted) {
  const Result<OpenedFile> opened = OpenFile(path, most);
  if (!opened) return opened.error();
  std::FILE* const file = opened->file.get();
  Bytes bytes;
  uint8_t buffer[65536];
  for (;;) {
    const size_t got = std::fread(buffer, 1, sizeof(buffer), file);
    const bool first = bytes.empty();
    bytes.insert(bytes.end(), buffer, buffer + got);
    if (first && is_wanted != nullptr && !is_wanted(bytes)) return bytes;
    if (first) bytes.reserve(opened->size);
    if (bytes.size() > most) return TooLarge(path, most, "more");
    if (got < sizeof(buffer)) break;
  }
  if (std::ferror(file) != 0) return Cannot("read", path, Reason(errno));
  return bytes;
}

}  // namespace

fs::path FollowLinks(fs::path path) {
  constexpr int kMostLinks = 40;  // limit of Linux
  std::error_code error;
  for (int count = 0; count < kMostLinks && fs::is_symlink(path, error); ++count) {
    path = FolderOf(path) / fs::read_symlink(path, error);
  }
  return path;
}

Result<Bytes> ReadFile(const std::string& path) { return ReadAtMost(path, kMostBytes, nullptr); }

Result<Bytes> ReadFileIf(const std::string& path, IsWanted is_wanted) {
  return ReadAtMost(path, kMostBytes, is_wanted);
}

Result<Bytes> ReadSmallFile(const std::string& path) {
  return ReadAtMost(path, kMostSmallBytes, nullptr);
}

Error WriteFile(const std::string& path, const Bytes& bytes) {
  if (IsStandardStream(path)) {
    const bool whole = WriteAll(bytes, stdout) && std::fflush(stdout) == 0;
    return whole ? Error() : Cannot("write", path + " to standard output", Reason(errno));
  }
  const fs::path target = FollowLinks(path);
  return IsSpecial(target) ? WriteInPlace(path, bytes) : Replace(path, target, bytes);
}

Error WriteFile(const std::string& path, const Result<Bytes>& encoded) {
  return encoded ? WriteFile(path, *encoded) : encoded.error();
}

Error WriteText(const std::string& path, const std::string& text) {
  return WriteFile(path, Bytes(text.begin(), text.end()));
}

Error CheckPlainFile(const std::string& path) {
  return IsSpecial(path) ? Cannot("read", path, kSpecial) : Error();
}

Error CheckOutputPath(const std::string& path) {
  std::error_code error;
  if (path.empty()) return Expected("output", "a file name", "an empty one");
  if (IsStandardStream(path)) return {};
  if (fs::is_directory(path, error)) return Cannot("write", path, "it is a folder");
  const fs::path folder = FolderOf(FollowLinks(path));
  const fs::file_status folder_status = fs::status(folder, error);
  if (!fs::exists(folder_status)) {
    const bool absent = !error || error == std::errc::no_such_file_or_directory;
    return absent ? Cannot("write", path, "folder " + folder.string() + " does not exist")
                  : Cannot("write", path, error);
  }
  if (!fs::is_directory(folder_status)) {
    return Cannot("write", path, folder.string() + " is not a folder");
  }
  struct stat status;
  if (stat(path.c_str(), &status) != 0 && errno != ENOENT) {
    return Cannot("write", path, Reason(errno));
  }
  if (IsSpecial(path)) return {};
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    return Cannot("write into folder", folder.string(), Reason(errno));
  }
  return IsProtected(path) ? ReadOnly(path) : Error();
}

std::string LowerExtension(const std::string& path) {
  return Lower(fs::path(path).extension().string());
}

}  // namespace starfocus

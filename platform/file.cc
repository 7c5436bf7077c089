#include "platform/file.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

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

// Opens a new file beside `path`; the name differs between processes and calls.
File OpenTemporary(const std::string& path, std::string* name) {
  static std::atomic<unsigned> counter{0};
  const auto stamp = std::chrono::steady_clock::now().time_since_epoch().count();
  for (int attempt = 0; attempt < 100; ++attempt) {
    *name = path + "." + std::to_string(stamp) + "-" + std::to_string(counter++) + ".part";
    std::FILE* file = std::fopen(name->c_str(), "wbx");
    if (file != nullptr || errno != EEXIST) return File(file);
  }
  return nullptr;
}

// Empty, or the reason why not all bytes reached the file.
std::string WriteAndClose(File file, const Bytes& bytes) {
  const bool whole =
      bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  if (!whole) return Reason(errno);
  if (std::fclose(file.release()) != 0) return Reason(errno);
  return "";
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

std::string ReadFile(const std::string& path, Bytes* bytes) {
  bytes->clear();
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) return Expected(path, "a readable file", Reason(errno));
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
  std::error_code error;
  fs::path target = path;
  // Renaming onto a link would replace the link instead of what it points to.
  if (fs::is_symlink(target, error)) {
    const fs::path real = fs::canonical(target, error);
    if (!error) target = real;
  }
  if (IsSpecial(target)) {
    File file(std::fopen(path.c_str(), "wb"));
    const std::string reason = file ? WriteAndClose(std::move(file), bytes) : Reason(errno);
    return reason.empty() ? "" : Expected(path, "a writable file", reason);
  }
  std::string temporary;
  File file = OpenTemporary(target.string(), &temporary);
  if (!file) return Expected(path, "a writable file", Reason(errno));
  std::string reason = WriteAndClose(std::move(file), bytes);
  if (reason.empty()) {
    fs::rename(temporary, target, error);
    if (error) reason = error.message();
  }
  if (reason.empty()) return "";
  fs::remove(temporary, error);
  return Expected(path, "a writable file", reason);
}

std::string CheckOutputPath(const std::string& path) {
  std::error_code error;
  if (path.empty()) return Expected("output", "a file name", "an empty one");
  if (fs::is_directory(path, error)) return Expected(path, "a file name", "a folder");
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  if (!fs::is_directory(folder, error)) {
    return Expected(path, "an existing folder", "no folder " + folder.string());
  }
  return "";
}

std::string LowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace starfocus

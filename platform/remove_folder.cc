// SPDX-License-Identifier: Apache-2.0
#include "platform/remove_folder.h"

#include <fcntl.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#else
#include <sys/wait.h>
#endif

namespace starfocus {

#ifdef __linux__

namespace {

constexpr int kOpenFolder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

// An entry of a folder as the kernel returns it.
struct Entry {
  uint64_t inode;
  int64_t next;
  uint16_t length;  // of this entry
  uint8_t type;
  char name[1];
};

constexpr size_t kMostName = 256;  // bytes of a file name with its zero

// Tries to remove each entry of a folder once. Returns true if an entry was removed. `child`
// receives the name of a subfolder that is not empty, or an empty name.
bool RemoveEntries(int folder, char* child) {
  constexpr size_t kLengthAt = offsetof(Entry, length), kNameAt = offsetof(Entry, name);
  bool removed = false;
  child[0] = '\0';
  lseek(folder, 0, SEEK_SET);
  alignas(Entry) char entries[2048];
  for (;;) {
    const long size = syscall(SYS_getdents64, folder, entries, sizeof(entries));
    if (size <= 0) return removed;
    uint16_t length = 0;
    for (long at = 0; at < size; at += length) {
      std::memcpy(&length, entries + at + kLengthAt, sizeof(length));
      const char* const name = entries + at + kNameAt;
      if (std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0) continue;
      if (unlinkat(folder, name, 0) == 0 || unlinkat(folder, name, AT_REMOVEDIR) == 0) {
        removed = true;
      } else if (errno == ENOTEMPTY && std::strlen(name) < kMostName) {
        std::strcpy(child, name);
      }
    }
  }
}

}  // namespace

void RemoveFolder(const char* path) {
  // Each round descends to one folder without subfolders, which the next round removes. This needs
  // two open folders and a fixed stack at any depth.
  for (bool removed = true; removed && rmdir(path) != 0;) {
    removed = false;
    char child[kMostName];
    for (int folder = open(path, kOpenFolder); folder >= 0;) {
      while (RemoveEntries(folder, child)) removed = true;
      const int next = child[0] != '\0' ? openat(folder, child, kOpenFolder) : -1;
      close(folder);
      folder = next;
    }
  }
}

#else

// The C library has no function that lists folders in a signal handler. RemoveFolder calls vfork,
// because fork may wait for a lock of the C library.
void RemoveFolder(const char* path) {
  const pid_t child = vfork();
  if (child == 0) {
    execl("/bin/rm", "rm", "-rf", "--", path, nullptr);
    _exit(1);
  }
  if (child > 0) waitpid(child, nullptr, 0);
}

#endif

}  // namespace starfocus

#include "platform/instruction_counter.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "platform/file.h"

namespace starfocus {

InstructionCounter::~InstructionCounter() {
  if (count_ != nullptr) munmap(const_cast<uint64_t*>(count_), sizeof(uint64_t));
}

std::string InstructionCounter::Open(const std::string& path) {
  const auto refuse = [&](const char* found) {
    return Expected(path, "a file that count_instructions.so,counter=FILE counts in", found);
  };
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return refuse("no readable file");
  struct stat info = {};
  const bool long_enough =
      fstat(file, &info) == 0 && S_ISREG(info.st_mode) && info.st_size >= off_t{sizeof(uint64_t)};
  void* memory = MAP_FAILED;
  if (long_enough) {
    memory = mmap(nullptr, sizeof(uint64_t), PROT_READ, MAP_SHARED, file, 0);
  }
  close(file);
  if (memory == MAP_FAILED) return refuse("another");
  count_ = static_cast<const volatile uint64_t*>(memory);
  const uint64_t before = Count();
  return Count() > before ? "" : refuse("one that nothing counts in");
}

}  // namespace starfocus

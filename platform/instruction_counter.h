// Instructions executed so far on a machine emulated by QEMU with tests/board/count_instructions.c.
#ifndef STARFOCUS_PLATFORM_INSTRUCTION_COUNTER_H_
#define STARFOCUS_PLATFORM_INSTRUCTION_COUNTER_H_

#include <cstdint>
#include <string>

namespace starfocus {

// The plugin counts in a file's first 8 bytes, which this maps.
class InstructionCounter {
 public:
  InstructionCounter() = default;
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  ~InstructionCounter();

  // Returns an error line, empty for success. What does not count is refused.
  std::string Open(const std::string& path);

  // Of the calling program, while it has one thread.
  uint64_t Count() const { return *count_; }

 private:
  const volatile uint64_t* count_ = nullptr;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_INSTRUCTION_COUNTER_H_

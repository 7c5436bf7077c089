// SPDX-License-Identifier: Apache-2.0
// GPIO lines of Linux boards through libgpiod, which nothing else knows. Built only where libgpiod
// (1.5 or newer, or 2.x) is found. A chip is named "gpiochip0", "/dev/gpiochip0" or "0"; lines are
// offsets on their chip.
#ifndef STARFOCUS_PLATFORM_GPIO_H_
#define STARFOCUS_PLATFORM_GPIO_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

struct GpioChip {
  std::string name, label;
  int lines;
};

// Every chip this user may open; an error when there is none.
Result<std::vector<GpioChip>> ListGpioChips();

enum class GpioBias { kAsIs, kPullUp, kPullDown };

// An edge of a line; `high` is the level it went to.
struct GpioEdge {
  int line;
  bool high;
  int64_t nanoseconds;  // of the monotonic clock
};

// Lines watched for edges of both directions. They are this program's until destruction.
class GpioInputs {
 public:
  GpioInputs();
  ~GpioInputs();
  Error Open(const std::string& chip, const std::vector<int>& lines, GpioBias bias);
  // Returns true if the line is high now.
  Result<bool> Read(int line);
  // Waits for edges and returns them in the order of their times; none after `timeout` milliseconds
  // without one (-1: no limit). The kernel drops edges when more than 16 per line wait.
  Result<std::vector<GpioEdge>> Wait(int timeout);

 private:
  struct Lines;
  std::unique_ptr<Lines> lines_;
};

// A line driven by this program, low at first.
class GpioOutput {
 public:
  GpioOutput();
  ~GpioOutput();
  Error Open(const std::string& chip, int line);
  Error Set(bool high);
  // Returns true if the line itself is high, where the chip can read its outputs.
  Result<bool> Read();

 private:
  struct Line;
  std::unique_ptr<Line> line_;
};

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_GPIO_H_

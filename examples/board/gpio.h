// SPDX-License-Identifier: Apache-2.0
// Accesses GPIO lines of Linux boards through libgpiod (1.5 or newer, or 2.x). This module is built
// only if libgpiod is available. Functions accept the GPIO chip names "gpiochip0", "/dev/gpiochip0"
// and "0". A line is identified by its offset on the chip.
#ifndef STARFOCUS_EXAMPLES_BOARD_GPIO_H_
#define STARFOCUS_EXAMPLES_BOARD_GPIO_H_

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

// Lists the GPIO chips that the user may open. Returns an error if the user may open no GPIO chip.
Result<std::vector<GpioChip>> ListGpioChips();

enum class GpioBias { kAsIs, kPullUp, kPullDown };

// A signal edge on a GPIO line. `high` is true if the level of the line is high after the edge.
struct GpioEdge {
  int line;
  bool high;
  int64_t nanoseconds;  // monotonic time
};

// GPIO input lines with detection of rising and falling edges. Other programs cannot use the lines
// until the destructor of GpioInputs runs.
class GpioInputs {
 public:
  GpioInputs();
  ~GpioInputs();
  Error Open(const std::string& chip, const std::vector<int>& lines, GpioBias bias);
  // Returns true if the current level of the line is high.
  Result<bool> Read(int line);
  // Waits for edges and returns them sorted by time. Returns an empty list after `timeout`
  // milliseconds without an edge (-1: no limit). The kernel drops edges of a line if more than 16
  // edges of the line are pending.
  Result<std::vector<GpioEdge>> Wait(int timeout);

 private:
  struct Lines;
  std::unique_ptr<Lines> lines_;
};

// A GPIO output line, whose initial level is low.
class GpioOutput {
 public:
  GpioOutput();
  ~GpioOutput();
  Error Open(const std::string& chip, int line);
  Error Set(bool high);
  // Returns true if the output line is high. Requires a GPIO chip that can read the levels of its
  // outputs.
  Result<bool> Read();

 private:
  struct Line;
  std::unique_ptr<Line> line_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_BOARD_GPIO_H_

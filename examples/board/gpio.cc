// SPDX-License-Identifier: Apache-2.0
#include "examples/board/gpio.h"

#include <gpiod.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "platform/file.h"

namespace starfocus {

namespace {

constexpr char kConsumer[] = "starfocus";
constexpr int kEdgesAtOnce = 16;  // number of edges that the kernel buffers for each line

bool IsNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

std::string ChipPath(const std::string& chip) {
  if (chip.find('/') != std::string::npos) return chip;
  return "/dev/" + (IsNumber(chip) ? "gpiochip" + chip : chip);
}

std::string Number(int64_t value) { return std::to_string(value); }

// Returns an error that starts with `where` and describes the reason in errno.
Error Failure(const std::string& where, const std::string& expected) {
  const int code = errno;
  if (code == EBUSY) return Expected(where, expected, "a line that another program holds");
  if (code == EACCES || code == EPERM) {
    return Expected(where, expected,
                    "no permission (run as root, or join the group of the device file)");
  }
  if (code == ENOENT || code == ENODEV || code == ENXIO) {
    return Expected(where, expected, "no such chip");
  }
  return Expected(where, expected, std::strerror(code));
}

struct CloseChip {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

int LineCount(gpiod_chip* chip);

Result<Chip> OpenChip(const std::string& name) {
  const std::string path = ChipPath(name);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return Expected(path, "a GPIO chip (--list shows the chips)", "no such file");
  }
  Chip chip(gpiod_chip_open(path.c_str()));
  if (chip == nullptr) return Failure(path, "a GPIO chip (--list shows the chips)");
  return chip;
}

Error CheckLine(const std::string& chip_name, gpiod_chip* chip, int line) {
  const int count = LineCount(chip);
  if (line >= 0 && line < count) return {};
  return Expected(ChipPath(chip_name), "a line from 0 to " + Number(count - 1), Number(line));
}

std::string LineName(const std::string& chip, int line) {
  return ChipPath(chip) + " line " + Number(line);
}

#ifndef STARFOCUS_GPIOD_2

int LineCount(gpiod_chip* chip) { return static_cast<int>(gpiod_chip_num_lines(chip)); }

GpioChip Describe(gpiod_chip* chip) {
  return {gpiod_chip_name(chip), gpiod_chip_label(chip), LineCount(chip)};
}

int BiasFlags(GpioBias bias) {
  if (bias == GpioBias::kPullUp) return GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
  if (bias == GpioBias::kPullDown) return GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
  return 0;
}

#else

int LineCount(gpiod_chip* chip) {
  gpiod_chip_info* info = gpiod_chip_get_info(chip);
  if (info == nullptr) return 0;
  const int count = static_cast<int>(gpiod_chip_info_get_num_lines(info));
  gpiod_chip_info_free(info);
  return count;
}

GpioChip Describe(gpiod_chip* chip) {
  gpiod_chip_info* info = gpiod_chip_get_info(chip);
  if (info == nullptr) return {gpiod_chip_get_path(chip), "", 0};
  GpioChip described = {gpiod_chip_info_get_name(info), gpiod_chip_info_get_label(info),
                        static_cast<int>(gpiod_chip_info_get_num_lines(info))};
  gpiod_chip_info_free(info);
  return described;
}

gpiod_line_bias BiasOf(GpioBias bias) {
  if (bias == GpioBias::kPullUp) return GPIOD_LINE_BIAS_PULL_UP;
  if (bias == GpioBias::kPullDown) return GPIOD_LINE_BIAS_PULL_DOWN;
  return GPIOD_LINE_BIAS_AS_IS;
}

// Requests `lines` from the kernel with `settings`, and frees `settings`. Returns null on failure.
gpiod_line_request* Request(gpiod_chip* chip, const std::vector<int>& lines,
                            gpiod_line_settings* settings) {
  const std::vector<unsigned> offsets(lines.begin(), lines.end());
  gpiod_line_config* config = gpiod_line_config_new();
  gpiod_request_config* request = gpiod_request_config_new();
  gpiod_line_request* made = nullptr;
  if (settings != nullptr && config != nullptr && request != nullptr) {
    gpiod_request_config_set_consumer(request, kConsumer);
    if (gpiod_line_config_add_line_settings(config, offsets.data(), offsets.size(), settings) ==
        0) {
      made = gpiod_chip_request_lines(chip, request, config);
    }
  }
  const int code = errno;
  if (request != nullptr) gpiod_request_config_free(request);
  if (config != nullptr) gpiod_line_config_free(config);
  if (settings != nullptr) gpiod_line_settings_free(settings);
  errno = code;
  return made;
}

struct ReleaseRequest {
  void operator()(gpiod_line_request* request) const { gpiod_line_request_release(request); }
};
using LineRequest = std::unique_ptr<gpiod_line_request, ReleaseRequest>;

struct FreeBuffer {
  void operator()(gpiod_edge_event_buffer* buffer) const { gpiod_edge_event_buffer_free(buffer); }
};

#endif

}  // namespace

Result<std::vector<GpioChip>> ListGpioChips() {
  std::vector<std::string> paths;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", failure)) {
    if (entry.path().filename().string().rfind("gpiochip", 0) == 0) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<GpioChip> chips;
  Error error;
  for (const std::string& path : paths) {
    const Result<Chip> chip = OpenChip(path);
    if (chip) chips.push_back(Describe(chip->get()));
    if (!error) error = chip.error();
  }
  if (!chips.empty()) return chips;
  return error ? error : Expected("/dev", "a GPIO chip (gpiochip0, ...)", "none");
}

GpioInputs::GpioInputs() = default;
GpioInputs::~GpioInputs() = default;
GpioOutput::GpioOutput() = default;
GpioOutput::~GpioOutput() = default;

#ifndef STARFOCUS_GPIOD_2

// Closing the chip releases its lines.
struct GpioInputs::Lines {
  Chip chip;
  std::string name;
  gpiod_line_bulk bulk;
};

struct GpioOutput::Line {
  Chip chip;
  std::string name;
  gpiod_line* line;
};

Error GpioInputs::Open(const std::string& chip, const std::vector<int>& lines, GpioBias bias) {
  auto opened = std::make_unique<Lines>();
  opened->name = ChipPath(chip);
  if (Error error = OpenChip(chip).MoveTo(&opened->chip)) return error;
  gpiod_line_bulk_init(&opened->bulk);
  for (const int line : lines) {
    if (Error error = CheckLine(chip, opened->chip.get(), line)) return error;
    gpiod_line* found = gpiod_chip_get_line(opened->chip.get(), static_cast<unsigned>(line));
    // Request lines individually, so that the error can name the line that is in use.
    if (found == nullptr ||
        gpiod_line_request_both_edges_events_flags(found, kConsumer, BiasFlags(bias)) != 0) {
      return Failure(LineName(chip, line), "a free input with interrupts");
    }
    gpiod_line_bulk_add(&opened->bulk, found);
  }
  lines_ = std::move(opened);
  return {};
}

Result<bool> GpioInputs::Read(int line) {
  gpiod_line* found = gpiod_chip_get_line(lines_->chip.get(), static_cast<unsigned>(line));
  const int value = found == nullptr ? -1 : gpiod_line_get_value(found);
  if (value < 0) return Failure(LineName(lines_->name, line), "a readable line");
  return value != 0;
}

Result<std::vector<GpioEdge>> GpioInputs::Wait(int timeout) {
  std::vector<GpioEdge> edges;
  const timespec limit = {timeout / 1000, timeout % 1000 * 1000000L};
  gpiod_line_bulk ready;
  int result = 0;
  do {
    // Wait for an hour at a time, because libgpiod 1 cannot wait without a limit.
    const timespec hour = {3600, 0};
    result = gpiod_line_event_wait_bulk(&lines_->bulk, timeout < 0 ? &hour : &limit, &ready);
  } while (result == 0 && timeout < 0);
  if (result < 0) return Failure(lines_->name, "readable edge events on the lines");
  for (unsigned i = 0; result > 0 && i < gpiod_line_bulk_num_lines(&ready); ++i) {
    gpiod_line* line = gpiod_line_bulk_get_line(&ready, i);
    gpiod_line_event events[kEdgesAtOnce];
    const int count = gpiod_line_event_read_multiple(line, events, kEdgesAtOnce);
    if (count < 0) return Failure(lines_->name, "readable edge events on the lines");
    for (int k = 0; k < count; ++k) {
      edges.push_back({static_cast<int>(gpiod_line_offset(line)),
                       events[k].event_type == GPIOD_LINE_EVENT_RISING_EDGE,
                       int64_t{events[k].ts.tv_sec} * 1000000000 + events[k].ts.tv_nsec});
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const GpioEdge& a, const GpioEdge& b) {
    return a.nanoseconds < b.nanoseconds;
  });
  return edges;
}

Error GpioOutput::Open(const std::string& chip, int line) {
  auto opened = std::make_unique<Line>();
  opened->name = LineName(chip, line);
  if (Error error = OpenChip(chip).MoveTo(&opened->chip)) return error;
  if (Error error = CheckLine(chip, opened->chip.get(), line)) return error;
  opened->line = gpiod_chip_get_line(opened->chip.get(), static_cast<unsigned>(line));
  if (opened->line == nullptr || gpiod_line_request_output(opened->line, kConsumer, 0) != 0) {
    return Failure(opened->name, "a free output");
  }
  line_ = std::move(opened);
  return {};
}

Error GpioOutput::Set(bool high) {
  if (gpiod_line_set_value(line_->line, high ? 1 : 0) == 0) return {};
  return Failure(line_->name, "an output that can be set");
}

Result<bool> GpioOutput::Read() {
  const int value = gpiod_line_get_value(line_->line);
  if (value < 0) return Failure(line_->name, "a readable line");
  return value != 0;
}

#else

struct GpioInputs::Lines {
  Chip chip;
  std::string name;
  LineRequest request;
  std::unique_ptr<gpiod_edge_event_buffer, FreeBuffer> buffer;
};

struct GpioOutput::Line {
  Chip chip;
  std::string name;
  unsigned offset;
  LineRequest request;
};

Error GpioInputs::Open(const std::string& chip, const std::vector<int>& lines, GpioBias bias) {
  auto opened = std::make_unique<Lines>();
  opened->name = ChipPath(chip);
  if (Error error = OpenChip(chip).MoveTo(&opened->chip)) return error;
  std::string names;
  for (const int line : lines) {
    if (Error error = CheckLine(chip, opened->chip.get(), line)) return error;
    names += (names.empty() ? " line " : ", ") + Number(line);
  }
  gpiod_line_settings* settings = gpiod_line_settings_new();
  if (settings != nullptr) {
    gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
    gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
    gpiod_line_settings_set_bias(settings, BiasOf(bias));
  }
  opened->request.reset(Request(opened->chip.get(), lines, settings));
  if (opened->request == nullptr) {
    return Failure(opened->name + names, "free inputs with interrupts");
  }
  opened->buffer.reset(gpiod_edge_event_buffer_new(lines.size() * kEdgesAtOnce));
  if (opened->buffer == nullptr) return Failure(opened->name, "memory for events");
  lines_ = std::move(opened);
  return {};
}

Result<bool> GpioInputs::Read(int line) {
  const gpiod_line_value value =
      gpiod_line_request_get_value(lines_->request.get(), static_cast<unsigned>(line));
  if (value == GPIOD_LINE_VALUE_ERROR) {
    return Failure(LineName(lines_->name, line), "a readable line");
  }
  return value == GPIOD_LINE_VALUE_ACTIVE;
}

Result<std::vector<GpioEdge>> GpioInputs::Wait(int timeout) {
  std::vector<GpioEdge> edges;
  const int64_t limit = timeout < 0 ? -1 : int64_t{timeout} * 1000000;
  const int result = gpiod_line_request_wait_edge_events(lines_->request.get(), limit);
  if (result < 0) return Failure(lines_->name, "readable edge events on the lines");
  if (result == 0) return edges;
  const int count = gpiod_line_request_read_edge_events(
      lines_->request.get(), lines_->buffer.get(),
      gpiod_edge_event_buffer_get_capacity(lines_->buffer.get()));
  if (count < 0) return Failure(lines_->name, "readable edge events on the lines");
  for (int i = 0; i < count; ++i) {
    gpiod_edge_event* event =
        gpiod_edge_event_buffer_get_event(lines_->buffer.get(), static_cast<unsigned long>(i));
    edges.push_back({static_cast<int>(gpiod_edge_event_get_line_offset(event)),
                     gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE,
                     static_cast<int64_t>(gpiod_edge_event_get_timestamp_ns(event))});
  }
  return edges;
}

Error GpioOutput::Open(const std::string& chip, int line) {
  auto opened = std::make_unique<Line>();
  opened->name = LineName(chip, line);
  opened->offset = static_cast<unsigned>(line);
  if (Error error = OpenChip(chip).MoveTo(&opened->chip)) return error;
  if (Error error = CheckLine(chip, opened->chip.get(), line)) return error;
  gpiod_line_settings* settings = gpiod_line_settings_new();
  if (settings != nullptr) {
    gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT);
    gpiod_line_settings_set_output_value(settings, GPIOD_LINE_VALUE_INACTIVE);
  }
  opened->request.reset(Request(opened->chip.get(), {line}, settings));
  if (opened->request == nullptr) return Failure(opened->name, "a free output");
  line_ = std::move(opened);
  return {};
}

Error GpioOutput::Set(bool high) {
  const gpiod_line_value value = high ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
  if (gpiod_line_request_set_value(line_->request.get(), line_->offset, value) == 0) return {};
  return Failure(line_->name, "an output that can be set");
}

Result<bool> GpioOutput::Read() {
  const gpiod_line_value value = gpiod_line_request_get_value(line_->request.get(), line_->offset);
  if (value == GPIOD_LINE_VALUE_ERROR) return Failure(line_->name, "a readable line");
  return value == GPIOD_LINE_VALUE_ACTIVE;
}

#endif

}  // namespace starfocus

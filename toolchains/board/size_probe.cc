// SPDX-License-Identifier: Apache-2.0
// Prints the memory that the engine requires on a board; used by toolchains/board/board size.
// `size_probe stack` prints the bytes of stack that calls of the engine use. `size_probe workspace`
// prints a table of workspaces, and `size_probe parts` prints a table of the parts of workspaces.
#include <pthread.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/memory_parts.h"
#include "tests/support/test_scene.h"

namespace {

constexpr size_t kStackBytes = 1 << 20;
constexpr uint8_t kPaint = 0xA5;

void Check(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "size_probe: %s failed\n", what);
  std::exit(1);
}

// Calls of the engine that are executed on a separate stack.
struct Calls {
  test::Config config;
  starfocus::Params params;
  starfocus_light_field field;
  void* workspace;
  size_t bytes;
  uint8_t* out;
  size_t out_stride;
  starfocus_status status;
  uintptr_t top;  // highest address of the stack that the calls use
};

uintptr_t FrameAddress() { return reinterpret_cast<uintptr_t>(__builtin_frame_address(0)); }

void* RunNothing(void* data) {
  static_cast<Calls*>(data)->top = FrameAddress();
  return nullptr;
}

void* RunCalls(void* data) {
  Calls* calls = static_cast<Calls*>(data);
  calls->top = FrameAddress();
  starfocus_engine* engine = nullptr;
  size_t needed = 0;
  calls->status = starfocus_workspace_size(&calls->config, &needed, nullptr);
  if (calls->status == STARFOCUS_OK) {
    calls->status =
        starfocus_init(&calls->config, calls->workspace, calls->bytes, &engine, nullptr);
  }
  if (calls->status == STARFOCUS_OK &&
      !test::Has(calls->config.features, STARFOCUS_FEATURE_STREAMING)) {
    calls->status = test::RefocusRgb(engine, &calls->params, &calls->field, calls->out,
                                     calls->out_stride, nullptr);
  } else if (calls->status == STARFOCUS_OK) {
    int32_t consumed = 0, written = 0;
    calls->status = starfocus_stream_begin(engine, &calls->params);
    if (calls->status == STARFOCUS_OK) {
      calls->status = starfocus_stream_push(engine, &calls->field, calls->config.height, &consumed);
    }
    if (calls->status == STARFOCUS_OK) {
      calls->status = test::PullRgb(engine, calls->out, calls->out_stride, calls->config.height,
                                    &written, nullptr);
    }
  }
  return nullptr;
}

// Returns the number of bytes of stack between the thread's first frame and the lowest byte that
// `run` has written.
size_t StackUsed(void* (*run)(void*), Calls* calls) {
  void* stack = nullptr;
  Check(posix_memalign(&stack, 65536, kStackBytes) == 0, "allocating a stack");
  std::memset(stack, kPaint, kStackBytes);
  pthread_attr_t attributes;
  pthread_t thread;
  Check(pthread_attr_init(&attributes) == 0, "pthread_attr_init");
  Check(pthread_attr_setstack(&attributes, stack, kStackBytes) == 0, "pthread_attr_setstack");
  Check(pthread_create(&thread, &attributes, run, calls) == 0, "pthread_create");
  Check(pthread_join(thread, nullptr) == 0, "pthread_join");
  const uint8_t* lowest = static_cast<const uint8_t*>(stack);
  while (*lowest == kPaint) ++lowest;
  const size_t used = calls->top - reinterpret_cast<uintptr_t>(lowest);
  std::free(stack);
  return used;
}

// Prints the largest stack use of all star sets and modes, for whole pictures and streams. Ends
// with an error if the engine uses no more stack than an empty thread.
void PrintStack() {
  size_t most = 0;
  for (const int views : {1, 5, 9, 17}) {
    for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK,
                                      STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_BLUR}) {
      for (const int streaming : {0, 1}) {
        const test::Scene scene = test::RandomScene(150, 90, views, -4, 4, 3);
        Calls calls = {};
        calls.config = test::ConfigFor(scene, 16);
        test::SetFeature(STARFOCUS_FEATURE_STREAMING, streaming, &calls.config.features);
        calls.params = test::Params(1, 1, mode);
        calls.field = scene.Field();
        test::Output out(150, 90);
        calls.out = out.bytes.data();
        calls.out_stride = out.stride;
        test::Engine memory(calls.config);
        Check(memory.status() == STARFOCUS_OK, "starfocus_init");
        calls.workspace = memory.workspace();
        calls.bytes = memory.bytes();
        const size_t nothing = StackUsed(RunNothing, &calls);
        const size_t used = StackUsed(RunCalls, &calls);
        Check(calls.status == STARFOCUS_OK, "refocusing");
        Check(used > nothing && used < kStackBytes / 2, "measuring the stack");
        most = used > most ? used : most;
      }
    }
  }
  std::printf("%zu\n", most);
}

size_t WorkspaceKilobytes(const starfocus_config& config) {
  size_t bytes = 0;
  Check(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK,
        "starfocus_workspace_size");
  return (bytes + 1023) / 1024;
}

// Prints a row for each picture and star set, and a column for each block size and blur radius.
void PrintWorkspace() {
  constexpr struct {
    const char* name;
    int width, height;
  } kSizes[] = {{"VGA", 640, 480}, {"HD", 1280, 720}, {"Full HD", 1920, 1080}};
  constexpr int kBlocks[] = {32, 64, 128}, kBlurs[] = {8, 32, 128};
  const auto row = [&](const char* name, const char* input, test::Config config) {
    std::printf("| %s | %s |", name, input);
    for (const int block : kBlocks) {
      for (const int blur : kBlurs) {
        config.superblock = block;
        config.max_blur = blur;
        std::printf(" %zu |", WorkspaceKilobytes(config));
      }
    }
    std::printf("\n");
  };
  std::printf("| | block, r: |");
  for (const int block : kBlocks) {
    for (const int blur : kBlurs) std::printf(" %d, %d |", block, blur);
  }
  std::printf("\n|---|---|");
  for (size_t i = 0; i < sizeof(kBlocks) / sizeof(int) * 3; ++i) std::printf("--:|");
  std::printf("\n");
  for (const auto& size : kSizes) {
    row(size.name, "whole pictures", test::BoardConfig(size.width, size.height, 17, 32, 8, 0));
    for (const int views : {1, 5, 17}) {
      char input[40];
      std::snprintf(input, sizeof(input), "%d streamed view%s", views, views == 1 ? "" : "s");
      row(size.name, input, test::BoardConfig(size.width, size.height, views, 32, 8, 1));
    }
  }
}

// Prints a table with a row for each part and a column for each configuration.
class PartsTable {
 public:
  PartsTable() {
    const struct {
      const char* name;
      test::Config config;
    } kColumns[] = {
        {"VGA, 1 streamed view, 32, 8", test::BoardConfig(640, 480, 1, 32, 8, 1)},
        {"VGA, 5 streamed views, 64, 32", test::BoardConfig(640, 480, 5, 64, 32, 1)},
        {"Full HD, whole pictures, 128, 128", test::BoardConfig(1920, 1080, 17, 128, 128, 0)}};
    std::printf("| |");
    for (const auto& column : kColumns) {
      std::printf(" %s |", column.name);
      columns_.push_back(test::MeasureParts(column.config));
      Check(!columns_.back().empty(), "measuring the parts");
    }
    std::printf("\n|---|");
    for (size_t k = 0; k < columns_.size(); ++k) std::printf("--:|");
    std::printf("\n");
  }

  void Print() const {
    // The first configuration has all parts of a workspace.
    const std::vector<test::MemoryPart>& streamed = columns_[0];
    for (const test::MemoryPart& part : streamed) {
      if (!part.shared) PrintPart(part.name, "%.1f");
    }
    PrintRow("tasks of a worker, which share memory", "%.1f",
             [](const auto& parts) { return test::SumOf(parts).shared; });
    for (const test::MemoryPart& part : streamed) {
      if (part.shared) PrintPart(part.name, "(%.1f)");
    }
    PrintRow("**all**", "**%.1f**", [](const auto& parts) { return test::SumOf(parts).all; });
  }

 private:
  template <class BytesOf>
  void PrintRow(const char* name, const char* format, const BytesOf& bytes_of) const {
    std::printf("| %s |", name);
    for (const auto& parts : columns_) {
      char text[40] = "";
      const size_t bytes = bytes_of(parts);
      if (bytes > 0) std::snprintf(text, sizeof(text), format, static_cast<double>(bytes) / 1024);
      std::printf(" %s |", text);
    }
    std::printf("\n");
  }

  void PrintPart(const char* name, const char* format) const {
    PrintRow(name, format, [name](const std::vector<test::MemoryPart>& parts) {
      for (const test::MemoryPart& part : parts) {
        if (std::strcmp(part.name, name) == 0) return part.bytes();
      }
      return size_t{0};
    });
  }

  std::vector<std::vector<test::MemoryPart>> columns_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "stack") == 0) return PrintStack(), 0;
  if (argc == 2 && std::strcmp(argv[1], "workspace") == 0) return PrintWorkspace(), 0;
  if (argc == 2 && std::strcmp(argv[1], "parts") == 0) return PartsTable().Print(), 0;
  std::fprintf(stderr, "usage: size_probe stack|workspace|parts\n");
  return 1;
}

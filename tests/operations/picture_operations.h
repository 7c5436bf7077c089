// SPDX-License-Identifier: Apache-2.0
// The operations that make a picture: all ways to ask for the picture of a case, with images of
// every format.
#ifndef STARFOCUS_TESTS_OPERATIONS_PICTURE_OPERATIONS_H_
#define STARFOCUS_TESTS_OPERATIONS_PICTURE_OPERATIONS_H_

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/operations/cases.h"
#include "tests/operations/operations.h"
#include "tests/support/images.h"

namespace properties {

// kPrepare prepares the light field and refocuses it; the other calls use a light field that was
// prepared before.
enum class Entry { kWhole, kStream, kAfter, kPrepared, kPrepare, kPreview };
inline constexpr Entry kEntries[] = {Entry::kWhole,    Entry::kStream,  Entry::kAfter,
                                     Entry::kPrepared, Entry::kPrepare, Entry::kPreview};

// A way to ask for the picture of a case.
struct Way {
  Entry entry = Entry::kWhole;
  starfocus_region region = {};  // No width: the whole picture.
  int push = 9, pull = 7;        // Largest number of rows per call of a stream.
  int shift = 1;                 // Preview shift.
  // Format of the centre view; the formats of the other views are random. -1: R, G, B of the scene.
  int images = -1;
  test::ImageKind kind = {STARFOCUS_FORMAT_RGB, 0, 0, 0, 5, 0};  // Format of the picture.
  // Seed of the images and of the changes since the previous frame. 0: one pixel near the end
  // changed, and the map of images has half the size and 16 bits.
  uint64_t seed = 0;

  std::string Text() const;
};

// Returns a random way, with or without images.
Way RandomWay(const Case& of, Entry entry, bool images, test::Random* random);
Way RandomWay(const Case& of, test::Random* random);

// Memory of exactly the required size, so that tools detect accesses beyond its end.
class Memory {
 public:
  // The bytes are `poison`. If `poison` is negative, they are not initialised; if above 255,
  // random.
  Memory(size_t bytes, int poison);
  void* get() const { return memory_.get(); }

  const size_t bytes;

 private:
  struct Free {
    void operator()(void* memory) const;
  };
  std::unique_ptr<void, Free> memory_;
};

// An engine in memory of exactly the required size.
class Rig {
 public:
  Rig(const test::Config& config, const Setup& setup);
  // Creates the engine again in the same memory.
  void Restart();
  starfocus_engine* get() const { return engine_; }
  const test::Config& config() const { return config_; }

 private:
  test::Config config_;
  const starfocus::simd::Kernels* kernels_;
  std::optional<Memory> memory_;
  starfocus_engine* engine_ = nullptr;
};

// An engine that asks for the picture of a case in one way.
class Picture {
 public:
  Picture(const Case& of, const Way& way, const Setup& setup);

  // Asks with these callbacks. Returns the bytes of the image, followed by the report. If `retries`
  // is given, repeats each call of a stream that failed or was cancelled, and counts them.
  starfocus_status Ask(const starfocus_callbacks& callbacks, Bytes* out, int* retries = nullptr);

  int width() const;
  int height() const;
  // The case, with the views and the map of the images.
  const Case& asked() const { return asked_; }
  const Way& way() const { return way_; }
  Rig* rig() { return &rig_; }
  starfocus_light_field Field(int row = 0) const {
    return images_ ? images_->Field(row) : asked_.scene.Field(row);
  }
  // Returns the alpha that a picture copies from the centre view.
  uint8_t Alpha(int x, int y) const { return images_ ? images_->Alpha(x, y) : uint8_t{255}; }

 private:
  void Use();
  starfocus_status Prepare(starfocus_engine* engine);
  starfocus_status Stream(test::ImageMemory* image, starfocus_report* report, int* retries);
  starfocus_status Make(test::ImageMemory* image, starfocus_report* report, int* retries);

  Way way_;
  std::optional<test::ImageField> images_;
  Case asked_;
  test::Scene before_;
  test::Output previous_{1, 1};
  Rig rig_;
  std::optional<Memory> memory_;
  starfocus_prepared* prepared_ = nullptr;
};

// Returns the bytes that every Setup must return first. They are those of the whole picture of the
// views, converted to R, G, B, from a new engine without a runner.
Bytes Expected(const Picture& of);

// The table of fixed operations: lenses of every kind in every way, and images of every format or
// only of NV12.
struct Lens {
  const char* name;
  starfocus_mode mode;
  starfocus_renderer renderer;
  double aperture;
  int views;
  float highlights = 1;
  // kFlat: a scene of one surface, which is blurred without views unless `gather` is 0. kLayers:
  // blocks of every layer.
  enum { kRandom, kFlat, kLayers } scene = kRandom;
  int gather = 1;
};
constexpr Lens kBlocks = {"blocks", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5};
constexpr Lens kBlur = {"blur", STARFOCUS_MODE_BLUR, STARFOCUS_RENDERER_AUTO, 1, 5};
constexpr Lens kPaper = {"benchmark, paper", STARFOCUS_MODE_BENCHMARK, STARFOCUS_RENDERER_LINE_SCAN,
                         0.3, 5};
constexpr Lens kLenses[] = {
    kBlocks,
    kBlur,
    kPaper,
    {"blocks, one view", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO, 0.7, 1},
    {"blocks, gathered", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5, 1, Lens::kFlat},
    {"blocks, layers", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5, 1, Lens::kLayers, 0},
    {"blocks, one layer", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5, 1, Lens::kFlat, 0},
    {"blocks, paper", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN, 0.5, 9},
    {"blocks, highlights", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 1, 5, 4},
    {"frame, paper", STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_LINE_SCAN, 0.5, 17},
    {"frame, one view", STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_AUTO, 1, 1},
    {"frame, subapertures", STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_SLICES, 1, 9},
    {"benchmark, slices", STARFOCUS_MODE_BENCHMARK, STARFOCUS_RENDERER_SLICES, 0.3, 5},
    {"pinhole", STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO, 0, 5},
};

// Size of the pictures of the table: three superblocks in each direction.
constexpr int kWidth = 70, kHeight = 75;

Case CaseOf(const Lens& lens);
Operation OperationOf(const std::string& name, int questions, const Case& of, const Way& way);
std::vector<Operation> PictureOperations(bool all_formats = true);

// The differential property: any call with any Setup, after other calls and failures, returns the
// bytes of the whole picture, or refuses a bad disparity.
void CheckAnyCall(const Case& of, test::Random* random);
// Checks a way of asking with a random Setup, and a call that may first fail.
void CheckWay(const Case& of, const Way& way, test::Random* random);

}  // namespace properties

#endif  // STARFOCUS_TESTS_OPERATIONS_PICTURE_OPERATIONS_H_

// SPDX-License-Identifier: Apache-2.0
// Light fields from seeds, an engine with its memory, and calls of the public interface. Pictures
// and streams are refocused into padded, poisoned output pictures.
#ifndef STARFOCUS_TESTS_SUPPORT_TEST_SCENE_H_
#define STARFOCUS_TESTS_SUPPORT_TEST_SCENE_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"

namespace test {

inline starfocus_status RefocusRgb(starfocus_engine* engine, const starfocus_params* params,
                                   const starfocus_light_field* field, uint8_t* out, size_t stride,
                                   starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return starfocus_refocus(engine, params, field, &image, report);
}

inline starfocus_status RefocusAfterRgb(starfocus_engine* engine, const starfocus_params* params,
                                        const starfocus_light_field* field,
                                        const starfocus_previous* previous, uint8_t* out,
                                        size_t stride, starfocus_report* report) {
  starfocus::Params after(*params);
  after.previous = previous;
  return RefocusRgb(engine, &after, field, out, stride, report);
}

inline starfocus_status RefocusPreparedRgb(starfocus_engine* engine, const starfocus_params* params,
                                           const starfocus_prepared* prepared, uint8_t* out,
                                           size_t stride, starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return starfocus_refocus_prepared(engine, params, prepared, &image, report);
}

inline starfocus_status Preview(starfocus_engine* engine, const starfocus_params* params,
                                const starfocus_prepared* prepared, int32_t shift,
                                const starfocus_image* out, starfocus_report* report) {
  starfocus::Params reduced(*params);
  reduced.preview_shift = shift;
  return starfocus_refocus_prepared(engine, &reduced, prepared, out, report);
}

inline starfocus_status PreviewRgb(starfocus_engine* engine, const starfocus_params* params,
                                   const starfocus_prepared* prepared, int32_t shift, uint8_t* out,
                                   size_t stride, starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return Preview(engine, params, prepared, shift, &image, report);
}

inline starfocus_status PullRgb(starfocus_engine* engine, uint8_t* out, size_t stride, int32_t rows,
                                int32_t* written, starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return starfocus_stream_pull(engine, &image, rows, written, report);
}

// Captures several values, as CAPTURE captures a single value.
#define CAPTURES(...) INFO(#__VA_ARGS__ " := ", test::Listed(__VA_ARGS__))

template <class... Values>
std::string Listed(const Values&... values) {
  std::ostringstream text;
  ((text << values << ", "), ...);
  return text.str();
}

constexpr uint8_t kPoison = 0xCD;

constexpr int kStars[] = {1, 5, 9, 17};  // numbers of views
constexpr starfocus_mode kModes[] = {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK,
                                     STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_BLUR};
constexpr starfocus_renderer kRenderers[] = {STARFOCUS_RENDERER_LINE_SCAN,
                                             STARFOCUS_RENDERER_SLICES};

// Random number generator whose sequence is equal on every machine (xorshift64*). If a fuzzer
// supplies bytes, the first numbers of the sequence are made from these bytes.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 0x1234567u) {}
  Random(const uint8_t* bytes, size_t size) : Random(0) {
    bytes_ = bytes;
    left_ = size;
  }

  uint32_t Next() {
    if (left_ > 0) return NextGiven();
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<uint32_t>((state_ * 0x2545F4914F6CDD1Du) >> 32);
  }
  // Returns an integer in [low, high].
  int Int(int low, int high) {
    return low + static_cast<int>(Next() % static_cast<uint32_t>(high - low + 1));
  }
  double Unit() { return Next() / 4294967295.0; }
  double Real(double low, double high) { return low + (high - low) * Unit(); }
  uint8_t Byte() { return static_cast<uint8_t>(Next() >> 24); }

 private:
  // Returns a number made from two of the fuzzer's bytes, which suffice for the ranges of the
  // tests.
  uint32_t NextGiven() {
    uint32_t value = *bytes_++;
    if (--left_ > 0) {
      value |= static_cast<uint32_t>(*bytes_++) << 8;
      --left_;
    }
    return value | value << 16;
  }

  uint64_t state_;
  const uint8_t* bytes_ = nullptr;
  size_t left_ = 0;
};

// Returns arbitrary bytes, or only the values 0 and 255.
inline std::vector<uint8_t> RandomBytes(size_t size, Random* random) {
  std::vector<uint8_t> bytes(size);
  const bool extreme = random->Int(0, 1) == 0;
  for (uint8_t& byte : bytes) byte = extreme ? uint8_t(255 * random->Int(0, 1)) : random->Byte();
  return bytes;
}

// A light field in memory. Strides may exceed the lengths of rows.
struct Scene {
  int width = 0;
  int height = 0;
  float disparity_min = 0;
  float disparity_max = 0;
  size_t stride = 0;           // Bytes.
  size_t disparity_width = 0;  // Floats.
  std::vector<std::vector<uint8_t>> pictures;
  std::vector<float> disparity;
  std::vector<uint8_t> coverage;  // Coverage in rows without padding; empty: no coverage.
  std::vector<starfocus_position>
      positions;  // positions of the views; empty: starfocus_view_position

  starfocus_position PositionOf(int view) const {
    if (!positions.empty()) return positions[static_cast<size_t>(view)];
    starfocus_position position;
    starfocus_view_position(view, &position.u, &position.v, nullptr);
    return position;
  }

  int views() const { return static_cast<int>(pictures.size()); }
  uint8_t* Pixel(int view, int x, int y) {
    return pictures[static_cast<size_t>(view)].data() + static_cast<size_t>(y) * stride +
           3 * static_cast<size_t>(x);
  }
  const uint8_t* Pixel(int view, int x, int y) const {
    return const_cast<Scene*>(this)->Pixel(view, x, y);
  }
  float& Disparity(int x, int y) {
    return disparity[static_cast<size_t>(y) * disparity_width + static_cast<size_t>(x)];
  }
  float Disparity(int x, int y) const { return const_cast<Scene*>(this)->Disparity(x, y); }

  // Returns the part of the light field that starts at `row`.
  starfocus_light_field Field(int row = 0) const {
    starfocus_light_field field = starfocus::NewLightField();
    for (size_t i = 0; i < pictures.size(); ++i) {
      field.views[i] =
          starfocus_image_rgb(pictures[i].data() + static_cast<size_t>(row) * stride, stride);
    }
    field.depth =
        starfocus_depth_float(disparity.data() + static_cast<size_t>(row) * disparity_width,
                              disparity_width * sizeof(float), width, height);
    if (coverage.empty()) return field;
    field.coverage = coverage.data() + static_cast<size_t>(row) * static_cast<size_t>(width);
    field.coverage_stride = static_cast<size_t>(width);
    return field;
  }
};

// Makes an empty scene of the given size. Adds `padding` bytes to each picture row and `padding`
// floats to each disparity row.
inline Scene EmptyScene(int width, int height, int views, float low, float high, int padding = 0) {
  Scene scene;
  scene.width = width;
  scene.height = height;
  scene.disparity_min = low;
  scene.disparity_max = high;
  scene.stride = 3 * static_cast<size_t>(width) + static_cast<size_t>(padding);
  scene.disparity_width = static_cast<size_t>(width + padding);
  scene.pictures.assign(static_cast<size_t>(views),
                        std::vector<uint8_t>(scene.stride * static_cast<size_t>(height), kPoison));
  scene.disparity.assign(scene.disparity_width * static_cast<size_t>(height), low);
  return scene;
}

// Sets random disparities within the scene's range: a slanted background and rectangles.
inline void RandomDisparity(Scene* scene, Random* random) {
  const double low = scene->disparity_min, high = scene->disparity_max;
  const auto put = [&](int x0, int y0, int x1, int y1) {
    const double base = random->Real(low, high);
    const bool slanted = random->Int(0, 2) == 0;
    const double dx = slanted ? random->Real(-0.2, 0.2) : 0;
    const double dy = slanted ? random->Real(-0.2, 0.2) : 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const float value = static_cast<float>(base + dx * (x - x0) + dy * (y - y0));
        scene->Disparity(x, y) = std::clamp(value, scene->disparity_min, scene->disparity_max);
      }
    }
  };
  put(0, 0, scene->width, scene->height);
  const int patches = 2 + scene->width * scene->height / 300;
  for (int i = 0; i < patches; ++i) {
    const int x = random->Int(0, scene->width - 1), y = random->Int(0, scene->height - 1);
    put(x, y, std::min(scene->width, x + random->Int(1, 24)),
        std::min(scene->height, y + random->Int(1, 24)));
  }
}

// Sets the disparity of each pixel (x, y) to at(x, y).
template <class At>
void SetDisparity(Scene* scene, const At& at) {
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) scene->Disparity(x, y) = at(x, y);
  }
}

// Sets a random disparity at each pixel, which is the worst case for runs of one shift.
inline void NoisyDisparity(Scene* scene, Random* random) {
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) {
      const float value =
          static_cast<float>(random->Real(scene->disparity_min, scene->disparity_max));
      scene->Disparity(x, y) = std::clamp(value, scene->disparity_min, scene->disparity_max);
    }
  }
}

// Makes random pictures with a random piecewise disparity map. The views are not consistent with
// each other.
inline Scene RandomScene(int width, int height, int views, float low, float high, uint64_t seed,
                         int padding = 0) {
  Random random(seed);
  Scene scene = EmptyScene(width, height, views, low, high, padding);
  for (auto& picture : scene.pictures) {
    for (uint8_t& sample : picture) sample = random.Byte();
  }
  RandomDisparity(&scene, &random);
  return scene;
}

// Makes a chequerboard of surfaces so near that hidden parts are read about a hundred pixels away
// in side views. Tests focus this scene at kNearFocus with an aperture of 0.2.
constexpr double kNearFocus = 100;
inline Scene NearScene(int width, int height, int views, uint64_t seed) {
  Scene scene = RandomScene(width, height, views, 85, 115, seed);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      scene.Disparity(x, y) = (x / 11 + y / 9) % 2 == 0 ? 85.0f : 115.0f;
    }
  }
  return scene;
}

inline test::Config ConfigFor(const Scene& scene, double max_blur = 32) {
  test::Config config;
  config.width = scene.width;
  config.height = scene.height;
  config.views = scene.views();
  std::copy(scene.positions.begin(), scene.positions.end(), config.positions);
  config.disparity_min = scene.disparity_min;
  config.disparity_max = scene.disparity_max;
  config.max_blur = max_blur;
  config.superblock = 64;  // Small scenes have several superblocks.
  return config;
}

// Keeps some views of a scene, and moves these views to random positions: along an axis, in one
// quadrant or anywhere.
inline void RandomViews(Scene* scene, starfocus_config* config, Random* random) {
  if (scene->views() > 1 && random->Int(0, 1) == 0) {
    scene->pictures.resize(static_cast<size_t>(random->Int(2, 4)));
  }
  const int kind = random->Int(0, 3), steps = random->Int(0, 1) == 0 ? 4 : 16384;
  scene->positions = {{0, 0}};
  while (scene->positions.size() < scene->pictures.size()) {
    starfocus_position position = {random->Int(-steps, steps) / double(steps),
                                   random->Int(-steps, steps) / double(steps)};
    if (kind == 0 && scene->positions.size() <= 4) position.v = 0;
    if (kind == 1) position = {std::max(0.0, position.u), std::max(0.0, position.v)};
    const auto alike = [&](const starfocus_position& other) {
      return other.u == position.u && other.v == position.v;
    };
    if (std::none_of(scene->positions.begin(), scene->positions.end(), alike)) {
      scene->positions.push_back(position);
    }
  }
  config->views = scene->views();
  std::copy(scene->positions.begin(), scene->positions.end(), config->positions);
}

inline starfocus::Params Params(double focus, double aperture = 1,
                                starfocus_mode mode = STARFOCUS_MODE_FRAME,
                                int32_t renderer = STARFOCUS_RENDERER_AUTO) {
  starfocus::Params params;
  params.study.renderer = renderer;
  params.focus = focus;
  params.aperture = aperture;
  params.study.mode = mode;
  return params;
}

// An engine in poisoned memory of exactly the required size.
class Engine {
 public:
  explicit Engine(const test::Config& config) : config_(config) {
    status_ = starfocus_workspace_size(&config, &bytes_, nullptr);
    if (status_ != STARFOCUS_OK) return;
    memory_.assign(bytes_ + STARFOCUS_ALIGNMENT, kPoison);
    status_ = starfocus_init(&config, workspace(), bytes_, &engine_, nullptr);
  }
  starfocus_status status() const { return status_; }
  starfocus_engine* get() const { return engine_; }
  const test::Config& config() const { return config_; }
  size_t bytes() const { return bytes_; }
  uint8_t* workspace() {
    const uintptr_t address = reinterpret_cast<uintptr_t>(memory_.data());
    return memory_.data() +
           (STARFOCUS_ALIGNMENT - address % STARFOCUS_ALIGNMENT) % STARFOCUS_ALIGNMENT;
  }

 private:
  test::Config config_;
  std::vector<uint8_t> memory_;
  size_t bytes_ = 0;
  starfocus_engine* engine_ = nullptr;
  starfocus_status status_ = STARFOCUS_OK;
};

// An output picture with poisoned rows and row padding.
struct Output {
  Output(int w, int h, int padding = 0)
      : width(w),
        height(h),
        stride(3 * static_cast<size_t>(w) + static_cast<size_t>(padding)),
        bytes(stride * static_cast<size_t>(h), kPoison) {}

  bool Untouched() const {
    return std::all_of(bytes.begin(), bytes.end(), [](uint8_t b) { return b == kPoison; });
  }
  bool PaddingUntouched() const {
    for (size_t row = 0; row < bytes.size(); row += stride) {
      for (size_t i = 3 * static_cast<size_t>(width); i < stride; ++i) {
        if (bytes[row + i] != kPoison) return false;
      }
    }
    return true;
  }
  const uint8_t* Pixel(int x, int y) const {
    return bytes.data() + static_cast<size_t>(y) * stride + 3 * static_cast<size_t>(x);
  }
  // Returns the pixels of the picture without row padding.
  std::vector<uint8_t> Tight() const {
    std::vector<uint8_t> tight;
    for (int y = 0; y < height; ++y) {
      tight.insert(tight.end(), Pixel(0, y), Pixel(0, y) + 3 * width);
    }
    return tight;
  }

  int width;
  int height;
  size_t stride;
  std::vector<uint8_t> bytes;
};

// Returns true if `part` is equal to the given region of the picture `whole`.
inline bool IsPartOf(const Output& part, const Output& whole, const starfocus_region& region) {
  for (int y = 0; y < region.height; ++y) {
    if (!std::equal(part.Pixel(0, y), part.Pixel(0, y) + 3 * region.width,
                    whole.Pixel(region.x, region.y + y))) {
      return false;
    }
  }
  return true;
}

// Runner that runs the jobs of a set on two threads.
inline int RunOnTwo(void*, starfocus_job job, void* data, int32_t count) {
  std::thread other([=] {
    for (int32_t i = 1; i < count; i += 2) job(data, i, 1);
  });
  for (int32_t i = 0; i < count; i += 2) job(data, i, 0);
  other.join();
  return 0;
}

// RunBy returns callbacks that consist of a runner, and ToldTo returns callbacks that consist of a
// progress function.
inline starfocus_callbacks RunBy(starfocus_runner runner, void* data = nullptr) {
  starfocus_callbacks callbacks = {};
  callbacks.runner = runner;
  callbacks.runner_data = data;
  return callbacks;
}
inline starfocus_callbacks ToldTo(starfocus_progress progress, void* data = nullptr) {
  starfocus_callbacks callbacks = {};
  callbacks.progress = progress;
  callbacks.progress_data = data;
  return callbacks;
}
// Returns callbacks that consist of an observer, which must stay valid until they are set.
inline starfocus_callbacks ObservedBy(const starfocus_observer* observer) {
  starfocus_callbacks callbacks = {};
  callbacks.observer = observer;
  return callbacks;
}
// Returns an observer that consists of a block visitor.
inline starfocus_observer Visitor(void (*on_block)(void* data, const starfocus_block* block),
                                  void* data = nullptr) {
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  observer.on_block = on_block;
  observer.on_block_data = data;
  return observer;
}

// Refocuses a scene. AnyEngine is a type with a function get(), such as Engine.
template <class AnyEngine>
starfocus_status Refocus(AnyEngine* engine, const starfocus::Params& params, const Scene& scene,
                         Output* out, const starfocus_callbacks& callbacks,
                         starfocus_report* report = nullptr) {
  const starfocus_status status = starfocus_set_callbacks(engine->get(), &callbacks);
  if (status != STARFOCUS_OK) return status;
  const starfocus_light_field field = scene.Field();
  return test::RefocusRgb(engine->get(), &params, &field, out->bytes.data(), out->stride, report);
}

template <class AnyEngine>
starfocus_status Refocus(AnyEngine* engine, const starfocus::Params& params, const Scene& scene,
                         Output* out, starfocus_runner runner = nullptr,
                         void* runner_data = nullptr, starfocus_report* report = nullptr) {
  return Refocus(engine, params, scene, out, RunBy(runner, runner_data), report);
}

// Streams a scene with at most `push_rows` rows per push and `pull_rows` rows per pull. Returns
// STARFOCUS_ERROR_STATE if the engine neither consumes nor returns rows.
template <class AnyEngine>
starfocus_status Stream(AnyEngine* engine, const starfocus::Params& params, const Scene& scene,
                        Output* out, int push_rows, int pull_rows,
                        const starfocus_callbacks& callbacks, starfocus_report* report = nullptr) {
  starfocus_status status = starfocus_set_callbacks(engine->get(), &callbacks);
  if (status == STARFOCUS_OK) status = starfocus_stream_begin(engine->get(), &params);
  int pushed = 0, pulled = 0;
  while (status == STARFOCUS_OK && pulled < scene.height) {
    int32_t consumed = 0, written = 0;
    const int rows_in = std::min(push_rows, scene.height - pushed);
    if (rows_in > 0) {
      const starfocus_light_field field = scene.Field(pushed);
      status = starfocus_stream_push(engine->get(), &field, rows_in, &consumed);
      if (status != STARFOCUS_OK) break;
    }
    const int rows_out = std::min(pull_rows, scene.height - pulled);
    status =
        test::PullRgb(engine->get(), out->bytes.data() + static_cast<size_t>(pulled) * out->stride,
                      out->stride, rows_out, &written, report);
    pushed += consumed;
    pulled += written;
    if (status == STARFOCUS_OK && consumed == 0 && written == 0) status = STARFOCUS_ERROR_STATE;
  }
  return status;
}

template <class AnyEngine>
starfocus_status Stream(AnyEngine* engine, const starfocus::Params& params, const Scene& scene,
                        Output* out, int push_rows, int pull_rows,
                        starfocus_runner runner = nullptr, void* runner_data = nullptr,
                        starfocus_report* report = nullptr) {
  return Stream(engine, params, scene, out, push_rows, pull_rows, RunBy(runner, runner_data),
                report);
}

#ifdef STARFOCUS_DATA_DIR
// Returns the folder of the data set `name`. If the data set is not on this machine, prints a
// message and returns an empty string.
inline std::string DataSet(const std::string& name) {
  const std::string folder = std::string(STARFOCUS_DATA_DIR) + "/" + name;
  if (std::FILE* file = std::fopen((folder + "/disparity.pfm").c_str(), "rb")) {
    std::fclose(file);
    return folder;
  }
  std::printf("SKIPPED: data set '%s' is not on this machine\n", name.c_str());
  return std::string();
}
#endif

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_TEST_SCENE_H_

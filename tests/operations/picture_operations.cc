// SPDX-License-Identifier: Apache-2.0
#include "tests/operations/picture_operations.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace properties {
namespace {

constexpr int kFormats = STARFOCUS_FORMAT_YUV_420_888 + 1;
constexpr int kDepthTypes = STARFOCUS_DEPTH_DEPTH16 + 1;
// Maps of few bits round disparities, by less than the range of a case of images is widened.
constexpr float kMostImageRange = 30;

// Part of the input that differs between a frame and the previous frame.
enum class Change { kDepths, kCentre, kSides, kRectangle, kEdges, kCoverage, kNothing };

struct Changer {
  const Case& of;
  test::Scene* scene;
  test::Random* random;

  int X() { return random->Int(0, scene->width - 1); }
  int Y() { return random->Int(0, scene->height - 1); }
  float Depth() {
    const int end = random->Int(0, 3);
    const float low = scene->disparity_min, high = scene->disparity_max;
    if (end == 0 && of.config.unknown == STARFOCUS_UNKNOWN_FILL)
      return std::numeric_limits<float>::quiet_NaN();
    if (end < 2) return end == 0 ? low : high;
    return std::clamp(static_cast<float>(random->Real(low, high)), low, high);
  }
  // Changes a pixel of a view, or of the map if `view` is negative.
  void Pixel(int view, int x, int y) {
    if (view < 0) {
      scene->Disparity(x, y) = Depth();
    } else {
      scene->Pixel(view, x, y)[random->Int(0, 2)] = random->Byte();
    }
  }
  void Apply(Change change) {
    if (change == Change::kNothing) return;
    if (change == Change::kRectangle) return Rectangle();
    for (int count = random->Int(0, 1) == 0 ? 1 : random->Int(1, 40); count > 0; --count) {
      if (change == Change::kDepths) Pixel(-1, X(), Y());
      if (change == Change::kCentre) Pixel(0, X(), Y());
      if (change == Change::kSides) Pixel(random->Int(0, scene->views() - 1), X(), Y());
      if (change == Change::kEdges) Edge();
      if (change == Change::kCoverage && !scene->coverage.empty()) {
        scene->coverage[size_t(Y()) * size_t(scene->width) + size_t(X())] = random->Byte();
      }
    }
  }
  void Rectangle() {
    const int x0 = X(), y0 = Y();
    const int x1 = random->Int(x0, scene->width - 1), y1 = random->Int(y0, scene->height - 1);
    const int view = random->Int(-2, scene->views() - 1);
    const float depth = Depth();
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        Pixel(view, x, y);
        if (view < 0) scene->Disparity(x, y) = depth;
      }
    }
  }
  // Changes a pixel of the first or last row or column.
  void Edge() {
    const bool upright = random->Int(0, 1) == 0, last = random->Int(0, 1) == 0;
    const int x = upright ? (last ? scene->width - 1 : 0) : X();
    const int y = upright ? Y() : (last ? scene->height - 1 : 0);
    Pixel(random->Int(-1, scene->views() - 1), x, y);
  }
};

test::Scene FrameBefore(const Case& of, uint64_t seed) {
  test::Scene before = of.scene;
  if (seed == 0) {
    before.Pixel(0, before.width * 5 / 7, before.height * 4 / 5)[1] ^= 64;
    return before;
  }
  test::Random random(seed);
  Changer changer = {of, &before, &random};
  for (int k = random.Int(1, 2); k > 0; --k) changer.Apply(static_cast<Change>(random.Int(0, 6)));
  return before;
}

// Returns images of the views and a map of any size and type. Some maps have unknown values.
test::ImageField MakeImages(const Case& of, const Way& way) {
  test::Random random(way.seed + 1);
  std::vector<test::ImageKind> kinds = {test::AnyKind(way.images, &random)};
  for (int k = 0; k < 2; ++k) kinds.push_back(test::AnyKind(random.Int(0, kFormats - 1), &random));
  test::Scene scene = of.scene;
  for (float& disparity : scene.disparity) {
    if (!std::isfinite(disparity)) disparity = scene.disparity_min;
  }
  int width = (scene.width + 1) / 2, height = (scene.height + 1) / 2, padding = 0;
  auto type = STARFOCUS_DEPTH_U16;
  auto meaning = STARFOCUS_DEPTH_RECIPROCAL;
  if (way.seed != 0) {
    const bool whole = random.Int(0, 4) == 0;
    width = whole ? scene.width : random.Int(1, scene.width);
    height = whole ? scene.height : random.Int(1, scene.height);
    type = starfocus_depth_type(random.Int(0, kDepthTypes - 1));
    meaning = starfocus_depth_meaning(random.Int(0, 1));
    padding = random.Int(0, 5);
  }
  test::DepthMemory depth = test::MakeDepth(scene, width, height, type, meaning, padding);
  depth.map.has_invalid = of.config.unknown == STARFOCUS_UNKNOWN_FILL;
  depth.map.invalid = type == STARFOCUS_DEPTH_U16 ? 65535 : 255;
  const bool is_real = type == STARFOCUS_DEPTH_FLOAT || type == STARFOCUS_DEPTH_HALF;
  for (int k = depth.map.has_invalid * width * height / 20; k > 0; --k) {
    depth.Put(random.Int(0, width - 1), random.Int(0, height - 1),
              is_real ? std::numeric_limits<double>::quiet_NaN() : double(depth.map.invalid));
  }
  return test::MakeImageField(scene, kinds, std::move(depth), &random);
}

// Returns the case of the images, converted to R, G, B.
Case Converted(const Case& of, const std::optional<test::ImageField>& images) {
  if (!images) return of;
  Case converted = of;
  converted.scene = images->converted;
  converted.scene.positions = of.scene.positions;
  converted.config.disparity_min = converted.scene.disparity_min;
  converted.config.disparity_max = converted.scene.disparity_max;
  const double more = converted.Radius() - of.Radius();
  converted.config.max_blur = std::min(STARFOCUS_MAX_BLUR, of.config.max_blur + more);
  return converted;
}

test::Config ConfigOf(const Case& of, const Way& way, const Setup& setup) {
  test::Config config = of.config;
  const bool streams = way.entry == Entry::kStream;
  const bool images =
      way.images >= 0 || way.kind.format != STARFOCUS_FORMAT_RGB || way.kind.pixel_stride > 3;
  if (streams || setup.spare) config.features |= STARFOCUS_FEATURE_STREAMING;
  if (images || setup.spare) config.features |= STARFOCUS_FEATURE_IMAGES;
  if (way.entry == Entry::kPreview || setup.spare)
    config.previews = std::max(config.previews, way.shift);
  return config;
}

// Appends the statistics, which no Setup may change.
void Append(const test::Report& report, Bytes* bytes) {
  const auto append = [&](uint64_t count) {
    for (int k = 0; k < 8; ++k) bytes->push_back(uint8_t(count >> 8 * k));
  };
  append(uint64_t(report.n));
  append(uint64_t(report.rendered_views));
  append(report.rendered_samples);
  for (const starfocus_layer_report& layer : report.layers) {
    for (const uint64_t count :
         {layer.blocks, layer.views, layer.pixels, layer.predicted_ps, layer.surface_pixels,
          layer.hidden_pixels, layer.filled_pixels, layer.selected_pixels, layer.shifted_pixels,
          layer.composited_pixels}) {
      append(count);
    }
  }
  append(report.copied_pixels);
  append(report.gathered_pixels);
  append(report.unknown_pixels);
}

// Returns a pixel, a row or a column at a border of the picture or of its blocks, or any region.
starfocus_region RandomRegion(int width, int height, test::Random* random) {
  const auto at = [random](int size) {
    const int edge = 32 * random->Int(1, 4) - random->Int(0, 8);
    const int place = random->Int(0, 3);
    return place == 0   ? 0
           : place == 1 ? size - 1
                        : std::min(size - 1, place == 2 ? edge : random->Int(0, size - 1));
  };
  starfocus_region region = {at(width), at(height), 1, 1};
  const int kind = random->Int(0, 4);
  if (kind == 1) region.x = 0, region.width = width;
  if (kind == 2) region.y = 0, region.height = height;
  if (kind > 2) region.width = random->Int(1, width - region.x);
  if (kind > 2) region.height = random->Int(1, height - region.y);
  return region;
}

test::Output Crop(const test::Output& whole, const starfocus_region& region) {
  test::Output part(region.width, region.height);
  for (int y = 0; y < region.height; ++y) {
    std::copy_n(whole.Pixel(region.x, region.y + y), part.stride,
                part.bytes.begin() + ptrdiff_t(part.stride) * y);
  }
  return part;
}

}  // namespace

Memory::Memory(size_t size, int poison)
    : bytes(size), memory_(::operator new (size, std::align_val_t{STARFOCUS_ALIGNMENT})) {
  auto* to = static_cast<uint8_t*>(memory_.get());
  if (poison >= 0 && poison <= 255) std::memset(to, poison, bytes);
  if (poison <= 255) return;
  // The random bytes repeat with a period of 1021 bytes, which is not a multiple of the element
  // sizes of tables.
  test::Random random(static_cast<uint64_t>(poison));
  const size_t drawn = std::min<size_t>(bytes, 1021);
  for (size_t i = 0; i < drawn; ++i) to[i] = random.Byte();
  for (size_t i = drawn; i < bytes; i += drawn) std::memcpy(to + i, to, std::min(drawn, bytes - i));
}

void Memory::Free::operator()(void* memory) const {
  ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
}

Rig::Rig(const test::Config& config, const Setup& setup)
    : config_(config), kernels_(setup.kernels) {
  config_.max_workers = setup.workers;
  config_.max_blur = std::min(STARFOCUS_MAX_BLUR, config.max_blur * setup.room);
  size_t bytes = 0;
  REQUIRE(starfocus_workspace_size(&config_, &bytes, nullptr) == STARFOCUS_OK);
  memory_.emplace(bytes, setup.poison);
  Restart();
}

void Rig::Restart() {
  REQUIRE(starfocus_init(&config_, memory_->get(), memory_->bytes, &engine_, nullptr) ==
          STARFOCUS_OK);
  if (kernels_ != nullptr) test::UseKernels(kernels_, engine_);
}

std::string Way::Text() const {
  constexpr const char* kNames[] = {"whole", "stream", "after", "prepared", "prepare", "preview"};
  return std::string(kNames[int(entry)]) + ", images " + std::to_string(images) + ", format " +
         std::to_string(kind.format) + ", region " +
         test::Listed(region.x, region.y, region.width, region.height) + "rows " +
         test::Listed(push, pull) + "seed " + std::to_string(seed);
}

Way RandomWay(const Case& of, Entry entry, bool images, test::Random* random) {
  const int width = of.scene.width, height = of.scene.height;
  Way way;
  way.entry = entry;
  if (entry != Entry::kStream && entry != Entry::kPreview && random->Int(0, 1) == 0) {
    way.region = RandomRegion(width, height, random);
  }
  const int most = random->Int(0, 1) == 0 ? random->Int(1, 40) : height;
  way.push = random->Int(1, most);
  way.pull = random->Int(1, most);
  way.shift = random->Int(1, STARFOCUS_MAX_PREVIEW);
  way.seed = random->Next() + 1u;
  way.kind.padding = random->Int(0, 5);
  if (entry == Entry::kAfter) return way;  // the previous picture is R, G, B
  if (random->Int(0, 3) == 0) way.kind = test::AnyKind(random->Int(0, kFormats - 1), random);
  // The widened range of disparities must not exceed the largest blur.
  const float range = of.scene.disparity_max - of.scene.disparity_min;
  const bool fits =
      range > 0 && range < kMostImageRange && of.Radius() + 1 < STARFOCUS_MAX_BLUR &&
      std::max(-of.scene.disparity_min, of.scene.disparity_max) + 1 < STARFOCUS_MAX_DISPARITY;
  if (images && fits) way.images = random->Int(0, kFormats - 1);
  // Pairs of rows share chroma samples.
  if (way.images >= 0 || way.kind.IsYuv()) way.push *= 2, way.pull *= 2;
  return way;
}

Way RandomWay(const Case& of, test::Random* random) {
  const Entry entry = kEntries[random->Int(0, 5)];
  return RandomWay(of, entry, random->Int(0, 2) == 0, random);
}

Picture::Picture(const Case& of, const Way& way, const Setup& setup)
    : way_(way),
      images_(way.images < 0 ? std::nullopt : std::optional(MakeImages(of, way))),
      asked_(Converted(of, images_)),
      rig_(ConfigOf(asked_, way, setup), setup) {
  if (way.entry == Entry::kAfter) {
    before_ = FrameBefore(asked_, way.seed);
    starfocus::Params params = asked_.params;
    params.region = way.region;
    previous_ = test::OutputOf(asked_.config, params, before_);
  }
  if (setup.used) Use();
  if (way.entry != Entry::kPrepared && way.entry != Entry::kPreview && way.entry != Entry::kPrepare)
    return;
  test::Config config = rig_.config();
  if (setup.maker == 0) {
    size_t bytes = 0;
    REQUIRE(starfocus_prepared_size(&config, &bytes, nullptr) == STARFOCUS_OK);
    memory_.emplace(bytes, setup.poison);
    REQUIRE(Prepare(rig_.get()) == STARFOCUS_OK);
    return;
  }
  test::Random random(setup.maker);
  if (random.Int(0, 1) == 0) config.superblock = 32 << random.Int(0, 3);
  if (random.Int(0, 1) == 0) config.max_blur = random.Real(0.5, 64);
  if (random.Int(0, 1) == 0) config.tuning.gather = 1 - config.tuning.gather;
  if (random.Int(0, 1) == 0) config.previews = random.Int(config.previews, STARFOCUS_MAX_PREVIEW);
  size_t bytes = 0;
  REQUIRE(starfocus_prepared_size(&config, &bytes, nullptr) == STARFOCUS_OK);
  memory_.emplace(bytes, setup.poison);
  Rig maker(config, {});
  REQUIRE(Prepare(maker.get()) == STARFOCUS_OK);
}

int Picture::width() const {
  const int all = way_.region.width > 0 ? way_.region.width : asked_.scene.width;
  return way_.entry == Entry::kPreview ? (all + (1 << way_.shift) - 1) >> way_.shift : all;
}
int Picture::height() const {
  const int all = way_.region.width > 0 ? way_.region.height : asked_.scene.height;
  return way_.entry == Entry::kPreview ? (all + (1 << way_.shift) - 1) >> way_.shift : all;
}

// Refocuses with other lenses, and abandons a stream, so that the memory holds data of these calls.
void Picture::Use() {
  const test::Scene& scene = asked_.scene;
  starfocus::Params params = asked_.params;
  params.aperture /= 2;
  params.study.renderer = STARFOCUS_RENDERER_SLICES;
  const starfocus_light_field field = scene.Field();
  test::Output out(scene.width, scene.height);
  for (const starfocus_mode mode : {STARFOCUS_MODE_BLUR, STARFOCUS_MODE_BLOCK}) {
    params.study.mode = mode;
    REQUIRE(test::RefocusRgb(rig_.get(), &params, &field, out.bytes.data(), out.stride, nullptr) ==
            STARFOCUS_OK);
  }
  if (!test::Has(rig_.config().features, STARFOCUS_FEATURE_STREAMING)) return rig_.Restart();
  int32_t moved = 0;
  REQUIRE(starfocus_stream_begin(rig_.get(), &params) == STARFOCUS_OK);
  REQUIRE(starfocus_stream_push(rig_.get(), &field, scene.height, &moved) == STARFOCUS_OK);
  REQUIRE(test::PullRgb(rig_.get(), out.bytes.data(), out.stride, (scene.height + 1) / 2, &moved,
                        nullptr) == STARFOCUS_OK);
}

starfocus_status Picture::Prepare(starfocus_engine* engine) {
  const starfocus_light_field field = Field();
  const starfocus_status status =
      starfocus_prepare(engine, &field, memory_->get(), memory_->bytes, &prepared_);
  CHECK((prepared_ == nullptr) == (status != STARFOCUS_OK));
  return status;
}

starfocus_status Picture::Stream(test::ImageMemory* image, starfocus_report* report, int* retries) {
  starfocus_status status = starfocus_stream_begin(rig_.get(), &asked_.params);
  while (retries != nullptr && status == STARFOCUS_ERROR_CANCELLED) {
    ++*retries;
    status = starfocus_stream_begin(rig_.get(), &asked_.params);
  }
  for (int pushed = 0, pulled = 0; status == STARFOCUS_OK && pulled < height();) {
    int32_t consumed = 0, written = 0;
    const int rows = std::min(way_.push, height() - pushed);
    const starfocus_light_field field = Field(pushed);
    if (rows > 0) status = starfocus_stream_push(rig_.get(), &field, rows, &consumed);
    if (status != STARFOCUS_OK) break;
    CHECK((!images_ || consumed % 2 == 0 || pushed + consumed == height()));
    const starfocus_image out = image->Out(pulled);
    status = starfocus_stream_pull(rig_.get(), &out, std::min(way_.pull, height() - pulled),
                                   &written, report);
    pushed += consumed;
    pulled += written;
    if (status == STARFOCUS_OK) REQUIRE(consumed + written > 0);
    if (retries == nullptr) continue;
    if (status == STARFOCUS_ERROR_RUNNER || status == STARFOCUS_ERROR_CANCELLED) {
      ++*retries;
      status = STARFOCUS_OK;
    }
  }
  return status;
}

starfocus_status Picture::Make(test::ImageMemory* image, starfocus_report* report, int* retries) {
  starfocus::Params params = asked_.params;
  params.region = way_.region;
  const starfocus_light_field field = Field();
  const starfocus_image out = image->Out();
  const starfocus_light_field before_field = before_.Field();
  const starfocus_image before_image =
      starfocus_image_rgb(previous_.bytes.data(), previous_.stride);
  const starfocus_previous previous = {sizeof previous, &before_field, &before_image};
  switch (way_.entry) {
    case Entry::kStream:
      return Stream(image, report, retries);
    case Entry::kAfter:
      params.previous = &previous;
      [[fallthrough]];
    case Entry::kWhole:
      return starfocus_refocus(rig_.get(), &params, &field, &out, report);
    case Entry::kPrepare: {
      const starfocus_status status = Prepare(rig_.get());
      const starfocus_callbacks none = {};
      REQUIRE(starfocus_set_callbacks(rig_.get(), &none) == STARFOCUS_OK);
      if (status != STARFOCUS_OK) return status;
      break;
    }
    case Entry::kPreview:
      params.preview_shift = way_.shift;
      break;
    case Entry::kPrepared:
      break;
  }
  return starfocus_refocus_prepared(rig_.get(), &params, prepared_, &out, report);
}

starfocus_status Picture::Ask(const starfocus_callbacks& callbacks, Bytes* out, int* retries) {
  REQUIRE(starfocus_set_callbacks(rig_.get(), &callbacks) == STARFOCUS_OK);
  test::ImageMemory image(width(), height(), way_.kind);
  test::Report report;
  const starfocus_status status = Make(&image, &report, retries);
  *out = image.Bytes();
  Append(report, out);
  return status;
}

Bytes Expected(const Picture& of) {
  const Way& way = of.way();
  const starfocus_region& region = way.region;
  test::Output picture(of.width(), of.height());
  if (way.entry == Entry::kPreview) {
    Way plain = way;
    plain.images = -1;
    plain.kind = {};
    Picture preview(of.asked(), plain, {});
    Bytes bytes;
    REQUIRE(preview.Ask({}, &bytes) == STARFOCUS_OK);
    std::copy_n(bytes.begin(), picture.bytes.size(), picture.bytes.begin());
  } else {
    picture = test::OutputOf(of.asked().config, of.asked().params, of.asked().scene);
    if (region.width > 0) picture = Crop(picture, region);
  }
  test::ImageMemory image(picture.width, picture.height, way.kind);
  const bool opaque = way.entry == Entry::kPreview;
  test::PutPicture(
      picture.bytes.data(), picture.stride,
      [&](int x, int y) { return opaque ? uint8_t{255} : of.Alpha(region.x + x, region.y + y); },
      &image);
  return image.Bytes();
}

Case CaseOf(const Lens& lens) {
  Case of;
  of.scene = test::RandomScene(kWidth, kHeight, lens.views, -3, 9, 8);
  if (lens.scene == Lens::kFlat) of.scene.disparity.assign(of.scene.disparity.size(), 9);
  if (lens.scene == Lens::kLayers) {
    test::SetDisparity(&of.scene, [](int x, int y) {
      return x < 33 ? y < 40 ? -3.0F : 9.0F : y < 32 ? 1.0F : 9.0F;
    });
  }
  for (int view = 0; view < lens.views; ++view) {  // 4x4 white pixels are a lamp
    for (int y = 40; y < 44; ++y) std::fill_n(of.scene.Pixel(view, 30, y), 12, uint8_t{255});
  }
  of.config = test::ConfigFor(of.scene, 13);
  of.config.superblock = 32;
  of.config.previews = 1;
  of.config.highlights = lens.highlights;
  of.config.tuning.gather = lens.gather;
  of.params = test::Params(-3, lens.aperture, lens.mode, lens.renderer);
  return of;
}

Operation OperationOf(const std::string& name, int questions, const Case& of, const Way& way) {
  const Picture picture(of, way, {});
  return {name, picture.height(), questions, [of, way](const Setup& setup) -> Run {
            const auto made = std::make_shared<Picture>(of, way, setup);
            return [made](const starfocus_callbacks& callbacks, Bytes* bytes) {
              return made->Ask(callbacks, bytes);
            };
          }};
}

std::vector<Operation> PictureOperations(bool all_formats) {
  std::vector<Operation> all;
  for (const Lens& lens : kLenses) {
    all.push_back(OperationOf(std::string("whole: ") + lens.name, 10, CaseOf(lens), {}));
  }
  struct Row {
    const char* name;
    Entry entry;
    starfocus_region region;
    int questions;
  };
  constexpr Row kRows[] = {{"region", Entry::kWhole, {21, 17, 30, 41}, 1},
                           {"stream", Entry::kStream, {}, 10},
                           {"after", Entry::kAfter, {}, 3},
                           {"prepared", Entry::kPrepared, {}, 10},
                           {"preview", Entry::kPreview, {}, 3},
                           {"prepare", Entry::kPrepare, {}, 7}};
  for (const Lens& lens : {kBlocks, kBlur, kPaper}) {
    for (const Row& row : kRows) {
      all.push_back(OperationOf(row.name + std::string(": ") + lens.name, row.questions,
                                CaseOf(lens), {row.entry, row.region}));
    }
  }
  for (int format = 0; format < kFormats; ++format) {
    if (!all_formats && format != STARFOCUS_FORMAT_NV12) continue;
    test::Random random(uint64_t(format) + 1);
    for (const Entry entry : {Entry::kWhole, Entry::kPrepare}) {
      Way way = {entry};
      way.images = format;
      way.kind = test::AnyKind(format, &random);
      all.push_back(OperationOf("images " + way.Text(), 7, CaseOf(kBlocks), way));
    }
  }
  return all;
}

}  // namespace properties

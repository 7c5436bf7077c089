// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/calibrate/block_times.h"

#include <algorithm>
#include <cmath>

#include "examples/lab/lab_config.h"
#include "lib/api/validate.h"
#include "lib/engine/stripe.h"
#include "lib/io/depth_map.h"
#include "lib/optics/rules.h"
#include "lib/plan/cells.h"
#include "platform/clock.h"
#include "platform/file.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

starfocus::Config MakeConfig(const LightField& light_field) {
  starfocus::Config config = ConfigOf(light_field);
  config.superblock = 256;  // Allocates scratch memory for blocks of any size.
  config.tuning.n_scale = STARFOCUS_MAX_N_SCALE;  // Allows apertures for every sampled N.
  return config;
}

}  // namespace

Error BlockBench::Open(const std::string& where, const LightField& light_field) {
  light_field_ = &light_field;
  const FloatMap& map = light_field.disparity;
  const starfocus_disparity_stats stats = MeasureDisparity(map);
  starfocus_status status = stats.invalid != 0 ? STARFOCUS_ERROR_NOT_FINITE : STARFOCUS_OK;
  if (status == STARFOCUS_OK) status = owner_.Init(MakeConfig(light_field));
  if (status == STARFOCUS_OK) {
    engine_ = reinterpret_cast<EngineState*>(owner_.get());
    // Create apertures for blocks of any N. The aperture has the default shape, as in
    // BlockBench::Focus.
    starfocus::Params params;
    SetOpening(ShapeOf(params), engine_->tables);
    const Demand demand = DemandOf(engine_->tables->opening);
    const int32_t last = LargestN(engine_->config, kSliceRenderer, demand, STARFOCUS_MAX_BLUR);
    status = MakeApertures(kSliceRenderer, last, nullptr, engine_->tables);
  }
  if (status != STARFOCUS_OK) {
    return Expected(where, "a light field that the engine accepts",
                    starfocus_status_string(status));
  }
  picture_ = Image(map.width, map.height);
  HoldDisparity();
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) HoldLayer(layer);
  return {};
}

void BlockBench::HoldDisparity() {
  const FloatMap& map = light_field_->disparity;
  disparity_.resize(map.values.size() + simd::kPadding);
  const Plane<int16_t> disparity = {disparity_.data(), size_t(map.width), 0, 0};
  // Disparities cannot be out of range, because the configuration has the range of the map.
  const FullConfig& config = engine_->config;
  const starfocus_depth_map given = EngineMap(map);
  const simd::DepthRule rule =
      RuleOf(given, float(config.disparity_min), float(config.disparity_max));
  ReadDepth(simd::BestImageKernels(), {given, rule, map.width, map.height, nullptr},
            {0, 0, map.width, map.height}, disparity);
  // The engine only reads the pixels.
  StoredViews views;
  for (size_t i = 0; i < light_field_->views.size(); ++i) {
    const Image& view = light_field_->views[i];
    views.codes[i] = {const_cast<uint8_t*>(view.pixels.data()), view.stride(), 0, 0};
  }
  engine_->input = InputOf(config, *engine_->kernels, views, disparity, {});
}

void BlockBench::HoldLayer(int layer) {
  LayerPlane& plane = engine_->layers.planes[layer];
  plane.width = engine_->input.Width(layer);
  plane.height = engine_->input.Height(layer);
  const size_t stride = 3 * size_t(plane.width), rows = size_t(plane.height);
  layer_samples_[layer].resize(stride * rows + simd::kPadding);
  plane.rows = {0, plane.height};
  plane.samples = {layer_samples_[layer].data(), stride, 0, 0};
  // Computes all rows at once, which requires more memory than a worker of the engine has.
  const int32_t step = engine_->config.superblock / 2;
  const auto columns = size_t(TapsOfLayer(step));
  const auto above = size_t(TapsOfLayer(plane.height));
  std::vector<int16_t> even(3 * (columns + 3) + simd::kPadding), odd = even;
  std::vector<int16_t> halved(3 * columns * (2 * above + 5) + simd::kPadding);
  std::vector<int16_t> layer_one(3 * columns * above + simd::kPadding);
  const ResampleScratch scratch = {even.data(), odd.data(), halved.data(), layer_one.data()};
  for (int32_t begin = 0; begin < plane.width; begin += step) {
    const int32_t end = std::min(begin + step, plane.width);
    DownsamplePicture(*engine_->kernels, engine_->input, layer, {begin, end}, scratch, plane);
  }
  engine_->input.layers[layer] = {plane.samples.data, stride, 0, 0};
}

void BlockBench::Focus(const BlockTask& task) {
  FullParams params = DefaultParams();
  params.focus = task.focus;
  params.aperture = task.aperture;
  SetLens(params, engine_);
}

BlockWork BlockBench::Work(const BlockTask& task) {
  Focus(task);
  const Block& block = task.block;
  const Rect& rect = block.rect;
  Content content[2] = {};
  std::vector<Cell> cells(size_t((rect.width + kCellSize - 1) / kCellSize));
  const int first = rect.x / kCellSize;
  for (int y = rect.y; y < rect.y + rect.height; y += kCellSize) {
    MeasureCells(*engine_->kernels, engine_->input, engine_->lens.scale, y / kCellSize,
                 {first, first + int(cells.size())}, cells.data());
    for (const Cell& cell : cells) AddCell(cell, &content);
  }
  const uint64_t upsampled = block.layer == 0 ? 0 : uint64_t(rect.width) * uint64_t(rect.height);
  BlockWork work = kSliceRenderer.measure_work(
      block.rendered, block.border, engine_->lens.weights_by_n[block.n], content, block.layer);
  work.upsample = upsampled;
  return work;
}

uint64_t BlockBench::Time(const BlockTask& task) {
  Focus(task);
  // Disable copying of blocks, since the model describes rendering.
  static const Renderer kAlways = [] {
    Renderer renderer = kSliceRenderer;
    renderer.nothing_moves = [](const RenderJob&) { return false; };
    return renderer;
  }();
  engine_->lens.renderer = &kAlways;
  const PictureRows out = {{picture_.pixels.data(), picture_.stride(), 0, 0}};
  const uint64_t start = ThreadNanoseconds();
  RefocusBlock(*engine_, task.block, out, engine_->scratch);
  return 1000 * (ThreadNanoseconds() - start);
}

namespace {

// The paper's range of block sizes. Sizes that are powers of two from 16 on are also measured at
// layers 1 and 2.
constexpr int kBlockSides[] = {8, 16, 24, 32, 48, 64, 96, 128, 160, 184};
constexpr int kLayerSides[] = {16, 32, 64, 128, 256};
constexpr int kViewNumbers[] = {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16};
constexpr int kMostViews = 16;

// Number of attempts to draw a random block, in each pass. Each pass permits more lenses and layers
// than the previous pass.
constexpr int kDraws = 60000;
enum Pass { kUsualLens, kAnyAperture, kAnyLayer, kPasses };

int DistanceBeyond(int position, int begin, int end) {
  return std::max({0, begin - position, position - (end - 1)});
}

}  // namespace

BlockSampler::BlockSampler(const FloatMap& disparity)
    : map_(disparity),
      columns_((disparity.width + kCellSize - 1) / kCellSize),
      rows_((disparity.height + kCellSize - 1) / kCellSize),
      cells_(size_t(columns_) * size_t(rows_), Cell{INFINITY, -INFINITY}),
      range_{INFINITY, -INFINITY} {
  for (int y = 0; y < map_.height; ++y) {
    for (int x = 0; x < map_.width; ++x) {
      Cell& cell = cells_[size_t(y / kCellSize) * size_t(columns_) + size_t(x / kCellSize)];
      for (Cell* each : {&cell, &range_}) {
        each->low = std::min(each->low, map_.at(x, y));
        each->high = std::max(each->high, map_.at(x, y));
      }
    }
  }
}

double BlockSampler::Radius(const Lens& lens, double disparity) const {
  return lens.aperture * std::fabs(disparity - lens.focus);
}

double BlockSampler::LargestRadius(const Lens& lens, const Cell& cell) const {
  return std::max(Radius(lens, cell.low), Radius(lens, cell.high));
}

double BlockSampler::SmallestRadius(const Lens& lens, const Cell& cell) const {
  if (cell.low <= lens.focus && lens.focus <= cell.high) return 0;
  return std::min(Radius(lens, cell.low), Radius(lens, cell.high));
}

// Returns a cell. For positions outside the picture, returns the nearest cell of the picture.
const BlockSampler::Cell& BlockSampler::At(int column, int row) const {
  column = std::clamp(column, 0, columns_ - 1);
  row = std::clamp(row, 0, rows_ - 1);
  return cells_[size_t(row) * size_t(columns_) + size_t(column)];
}

double BlockSampler::SmallestRadius(const Lens& lens, const Rect& rect) const {
  double smallest = STARFOCUS_MAX_BLUR;
  for (int row = rect.y / kCellSize; row * kCellSize < rect.y + rect.height; ++row) {
    for (int column = rect.x / kCellSize; column * kCellSize < rect.x + rect.width; ++column) {
      smallest = std::min(smallest, SmallestRadius(lens, At(column, row)));
    }
  }
  return smallest;
}

// Returns the largest blur radius of all cells, which are squares of kCellSize pixels, whose
// blurred light reaches the rectangle.
double BlockSampler::SplattingRadius(const Lens& lens, const Rect& rect) const {
  const int reach = static_cast<int>(LargestRadius(lens, range_)) / kCellSize + 2;
  const int left = rect.x / kCellSize, top = rect.y / kCellSize;
  const int right = (rect.x + rect.width - 1) / kCellSize;
  const int bottom = (rect.y + rect.height - 1) / kCellSize;
  double largest = 0;
  for (int row = top - reach; row <= bottom + reach; ++row) {
    for (int column = left - reach; column <= right + reach; ++column) {
      const int across =
          std::max(DistanceBeyond(column, left, right + 1), DistanceBeyond(row, top, bottom + 1));
      const double radius = LargestRadius(lens, At(column, row));
      if (radius >= (across - 1) * kCellSize) largest = std::max(largest, radius);
    }
  }
  return largest;
}

BlockSampler::Lens BlockSampler::RandomLens(int pass) {
  // The focus lies within the disparity range of the scene or slightly outside. In the pass
  // kAnyLayer, the focus may lie farther outside the disparity range.
  const double beyond = pass == kAnyLayer ? 24 : 8;
  Lens lens;
  lens.focus = range_.low - beyond + Random() * (range_.high - range_.low + 2 * beyond);
  lens.aperture = pass == kUsualLens ? 1.0 / (1 + RandomBelow(2)) : std::pow(20.0, -Random());
  return lens;
}

// Returns the border around a rectangle of the picture that contains all pixels that splat into the
// rectangle.
Border BlockSampler::FindBorder(const Lens& lens, const Rect& rect, int r_max) const {
  Border border = {0, 0, 0, 0};
  const int right = rect.x + rect.width, bottom = rect.y + rect.height;
  for (int y = rect.y - r_max - 1; y <= bottom + r_max; ++y) {
    for (int x = rect.x - r_max - 1; x <= right + r_max; ++x) {
      const int dx = DistanceBeyond(x, rect.x, right), dy = DistanceBeyond(y, rect.y, bottom);
      if (dx == 0 && dy == 0) continue;
      const double disparity =
          map_.at(std::clamp(x, 0, map_.width - 1), std::clamp(y, 0, map_.height - 1));
      if (Radius(lens, disparity) < std::max(dx, dy) - 1) continue;
      int32_t& side = x < rect.x ? border.left : border.right;
      int32_t& end = y < rect.y ? border.top : border.bottom;
      side = std::max(side, dx);
      end = std::max(end, dy);
    }
  }
  return border;
}

std::optional<BlockTask> BlockSampler::Draw(int pass, const BlockKind& kind) {
  const int side = kind.side, layer = kind.layer;
  if (side > map_.width || side > map_.height) return {};
  const Lens lens = RandomLens(pass);
  if (LargestRadius(lens, range_) > STARFOCUS_MAX_BLUR) return {};
  const int grid = 1 << layer;
  const Rect rect = {RandomBelow(map_.width - side + 1) / kCellSize * kCellSize,
                     RandomBelow(map_.height - side + 1) / kCellSize * kCellSize, side, side};
  const int rule = LayerByPaper(SmallestRadius(lens, rect));
  if (rule != layer && !(pass == kAnyLayer && rule > layer)) return {};
  const double r_max = SplattingRadius(lens, rect);
  BlockTask task = {lens.focus, lens.aperture, {}};
  Block& block = task.block;
  block.n = ViewsByPaper(r_max / grid);
  if (block.n < 1 || block.n > kMostViews) return {};
  if (kind.n != 0 && block.n != kind.n) return {};
  const int margin = kUpsampleBorder[layer];
  const Rect extended = {rect.x - margin, rect.y - margin, side + 2 * margin, side + 2 * margin};
  Border border = FindBorder(lens, extended, static_cast<int>(std::ceil(r_max)));
  for (int32_t* each : {&border.left, &border.right, &border.top, &border.bottom}) {
    *each = ((*each + grid - 1) >> layer) + 1;
  }
  block.rect = rect;
  block.rendered = {extended.x >> layer, extended.y >> layer, extended.width >> layer,
                    extended.height >> layer};
  block.border = border;
  block.layer = layer;
  return task;
}

std::vector<BlockGroup> BlockSampler::Sample(int count) {
  std::vector<BlockGroup> groups;
  for (int side : kBlockSides) {
    for (int n : kViewNumbers) groups.push_back({{side, 0, n}, {}});
  }
  for (int side : kLayerSides) {
    for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) groups.push_back({{side, layer, 0}, {}});
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    for (int draw = 0; draw < kDraws; ++draw) {
      BlockGroup& group = groups[size_t(RandomBelow(static_cast<int>(groups.size())))];
      const size_t wanted = size_t(group.kind.layer == 0 ? count : 4 * count);
      if (group.tasks.size() >= wanted) continue;
      const std::optional<BlockTask> task = Draw(pass, group.kind);
      if (task) group.tasks.push_back(*task);
    }
  }
  groups.erase(std::remove_if(groups.begin(), groups.end(),
                              [](const BlockGroup& group) { return group.tasks.empty(); }),
               groups.end());
  return groups;
}

}  // namespace starfocus

// SPDX-License-Identifier: Apache-2.0
#include "lib/plan/partition.h"

#include "lib/optics/psf.h"

namespace starfocus {
namespace {

// Returns the number of taps in one quarter of the gathering filter of blur radius `radius`
// (kDisparityBits). A disc covers pi / 4 = 0.785 of its square. The factor is 51/64 = 0.797,
// because pixels at the rim count although the disc covers them only in part.
uint64_t GatherTaps(int32_t radius) {
  const int32_t size = (radius + (3 << kDisparityBits) / 2) >> kDisparityBits;
  return static_cast<uint64_t>((size + 1) * (size + 1) * 51 / 64);
}

}  // namespace

uint64_t PredictTime(const starfocus_timing& timing, const BlockWork& work) {
  return timing.block + timing.field * work.field + timing.a * work.a + timing.b * work.b +
         timing.c * work.c + timing.upsample * work.upsample + timing.span * work.span +
         timing.hole * work.hole;
}

uint64_t PredictGather(const starfocus_timing& timing, uint64_t pixels, int32_t radius) {
  // The estimate assumes that each pixel costs 16 taps in addition to the taps of its radius. A tap
  // costs 1/64 of an upsampled pixel.
  return timing.upsample * pixels * (GatherTaps(radius) + 16) / 64;
}

// Coefficients block, field, a, b, c, upsample, span and hole, measured by `starfocus-lab
// calibrate` on an x86-64 processor with AVX-512. Separate coefficients for boards were tried,
// fitted to instruction counts of AArch64 and ARMv6. With the separate coefficients, block mode
// took between 1.7 % more and 0.4 % fewer instructions on these processors.
starfocus_timing DefaultTiming() { return {5659266, 0, 2354, 0, 106, 3266, 720, 507}; }

namespace {

constexpr double kRadiusOne = 1 << kDisparityBits;

int32_t CeilShift(int32_t value, int32_t layer) { return (value + (1 << layer) - 1) >> layer; }

// Converts a border of a block to a border of its rendered rectangle, in pixels of the layer.
// `beyond` is the number of pixels of the unclipped block outside the picture. One pixel is added,
// because a subaperture uses the neighbour of a pixel as well.
int32_t LayerBorder(int32_t border, int32_t beyond, int32_t layer) {
  return Max(0, CeilShift(border + beyond, layer) - UpsampleBorder(layer)) + 1;
}

class Partition {
 public:
  Partition(const PartitionRules& rules, const CellGrid& cells, int32_t x, int32_t y,
            PartitionCandidate* candidates, const GatherMap& gathered)
      : rules_(rules),
        cells_(cells),
        candidates_(candidates),
        gathered_(gathered),
        config_(*rules.config),
        side_(rules.config->superblock / kSmallestBlock),
        x_(x),
        y_(y) {
    while ((1 << levels_) < side_) ++levels_;
  }

  void Measure(int16_t* samples) {
    // `inside` covers the cells of complete smallest blocks, which may extend beyond the picture.
    const Rect inside = {x_ / kCellSize, y_ / kCellSize, CellsWithin(config_.width - x_),
                         CellsWithin(config_.height - y_)};
    const Surroundings surroundings =
        LoadSurroundings(cells_, rules_.scale, inside, rules_.around, samples);
    FindGathered(surroundings);
    for (int level = 0; level <= levels_; ++level) {
      const int32_t count = side_ >> level;
      for (int32_t row = 0; row < count; ++row) {
        for (int32_t column = 0; column < count; ++column) {
          if (!Inside(level, column, row)) continue;
          MeasureCandidate(level, column, row, surroundings);
          Plan(level, column, row);
        }
      }
    }
  }

  int32_t Emit(Block* blocks) {
    count_ = 0;
    EmitBlocks(levels_, 0, 0, blocks);
    return count_;
  }

 private:
  int32_t SideOf(int level) const { return kSmallestBlock << level; }
  PartitionCandidate& Candidate(int level, int32_t column, int32_t row) const {
    int32_t index = row * (side_ >> level) + column;
    for (int below = 0; below < level; ++below) index += (side_ >> below) * (side_ >> below);
    return candidates_[index];
  }
  bool Inside(int level, int32_t column, int32_t row) const {
    return x_ + column * SideOf(level) < config_.width && y_ + row * SideOf(level) < config_.height;
  }

  void MeasureCandidate(int level, int32_t column, int32_t row, const Surroundings& surroundings) {
    PartitionCandidate& candidate = Candidate(level, column, row);
    candidate.cells = 0;
    for (int32_t layer = 0; layer < STARFOCUS_LAYERS; ++layer) candidate.gathered[layer] = 0;
    for (int32_t layer = 0; layer < STARFOCUS_LAYERS; ++layer) candidate.gather[layer] = 0;
    if (level == 0) {
      MeasureSmallest(column, row, surroundings, &candidate);
      return;
    }
    const BlockStats* children[4];
    for (int child = 0; child < 4; ++child) {
      const int32_t cx = 2 * column + (child & 1), cy = 2 * row + (child >> 1);
      const bool inside = Inside(level - 1, cx, cy);
      children[child] = inside ? &Candidate(level - 1, cx, cy).stats : nullptr;
      if (!inside) continue;
      const PartitionCandidate& part = Candidate(level - 1, cx, cy);
      candidate.cells += part.cells;
      for (int32_t layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
        candidate.gathered[layer] += part.gathered[layer];
        candidate.gather[layer] += part.gather[layer];
      }
    }
    candidate.stats = MergeBlocks(children, SideOf(level - 1));
  }

  // Returns the number of cells in the smallest blocks that cover `pixels` pixels of the picture.
  int32_t CellsWithin(int32_t pixels) const {
    constexpr int32_t kCells = kSmallestBlock / kCellSize;
    return kCells * Min(side_, (pixels + kSmallestBlock - 1) / kSmallestBlock);
  }

  void FindGathered(const Surroundings& inside) {
    const int32_t right = Min(inside.column + inside.columns, cells_.columns);
    const int32_t bottom = Min(inside.row + inside.rows, cells_.rows);
    CellKind smooth[kMaxRowCells] = {};  // initially kMixed
    for (int32_t y = inside.row; y < bottom; ++y) {
      if (rules_.gathers) FindSmooth(*rules_.kernels, inside, rules_.scale, y, smooth);
      for (int32_t x = inside.column; x < right; ++x) {
        gathered_.At(x * kCellSize, y * kCellSize) =
            MarkOf(*cells_.At(x, y), smooth[x - inside.column]);
      }
    }
  }

  // Returns the GatherMap entry of a cell: the lowest layer whose PSFs are large enough for the
  // blur of the cell.
  static uint8_t MarkOf(const Cell& cell, CellKind smooth) {
    if (smooth == CellKind::kMixed) return kByViews;
    uint8_t layer = 0;
    while (layer < kByViews && cell.r_max > kMaxGather << (kDisparityBits + layer)) ++layer;
    return smooth == CellKind::kSloped ? layer | kSlopeMark : layer;
  }

  void MeasureSmallest(int32_t column, int32_t row, const Surroundings& surroundings,
                       PartitionCandidate* candidate) {
    const int32_t cell_x = x_ / kCellSize + 2 * column, cell_y = y_ / kCellSize + 2 * row;
    candidate->stats = MeasureBlock(*rules_.kernels, cells_, surroundings, cell_x, cell_y);
    for (int32_t y = cell_y; y < Min(cell_y + 2, cells_.rows); ++y) {
      for (int32_t x = cell_x; x < Min(cell_x + 2, cells_.columns); ++x) {
        ++candidate->cells;
        const int32_t first = gathered_.FirstLayer(x * kCellSize, y * kCellSize);
        for (int32_t layer = first; layer < STARFOCUS_LAYERS; ++layer) {
          ++candidate->gathered[layer];
          candidate->gather[layer] += PredictGather(
              config_.tuning.timing, static_cast<uint64_t>(kCellSize * kCellSize) >> 2 * layer,
              cells_.At(x, y)->r_max >> layer);
        }
      }
    }
  }

  Rect RectOf(int level, int32_t column, int32_t row) const {
    const int32_t side = SideOf(level);
    const int32_t x = x_ + column * side, y = y_ + row * side;
    return {x, y, Min(side, config_.width - x), Min(side, config_.height - y)};
  }

  // Plans the candidate as one block, and stores the predicted time of the block or of its
  // children, whichever is smaller.
  void Plan(int level, int32_t column, int32_t row) {
    PartitionCandidate& candidate = Candidate(level, column, row);
    Block& block = candidate.block;
    block.rect = RectOf(level, column, row);
    ChooseParameters(candidate.stats, SideOf(level), &block);
    if (PsfIndex(candidate.stats.r_max) > 0) PlanGathering(candidate, &block);
    if (SideOf(level) > rules_.largest_side) block.cost = UINT64_MAX;
    uint64_t best = block.cost;
    if (level > 0) best = Smaller(best, ChildrenCost(level, column, row));
    candidate.best = best;
  }

  // Plans to blur all smooth cells without views, at the layer chosen for the block's views. If all
  // cells of a block can be blurred without views at layer 0, the block uses layer 0. Blurring at
  // layer 0 is closer to ground truth and takes little or no extra time (docs/constants.md).
  void PlanGathering(const PartitionCandidate& candidate, Block* block) const {
    const auto cells = static_cast<uint64_t>(candidate.cells);
    const auto gathered = static_cast<uint64_t>(candidate.gathered[block->layer]);
    if (gathered > 0) {
      const uint64_t upsample = config_.tuning.timing.upsample * UpsampledPixels(*block);
      const uint64_t views = block->cost - upsample;
      block->cost = candidate.gather[block->layer] + upsample + views * (cells - gathered) / cells;
      block->gathers = true;
    }
    if (block->layer > 0 && candidate.gathered[0] == candidate.cells) {
      block->cost = candidate.gather[0];
      block->layer = 0;
      block->gathers = true;
    }
  }

  static uint64_t UpsampledPixels(const Block& block) {
    if (block.layer == 0) return 0;
    return static_cast<uint64_t>(block.rect.width) * static_cast<uint64_t>(block.rect.height);
  }

  static uint64_t Smaller(uint64_t a, uint64_t b) { return b < a ? b : a; }

  uint64_t ChildrenCost(int level, int32_t column, int32_t row) const {
    uint64_t sum = 0;
    for (int child = 0; child < 4; ++child) {
      const int32_t cx = 2 * column + (child & 1), cy = 2 * row + (child >> 1);
      if (Inside(level - 1, cx, cy)) sum += Candidate(level - 1, cx, cy).best;
    }
    return sum;
  }

  int32_t Views(int32_t r_max, int32_t layer) const {
    const double radius = static_cast<double>(r_max) / (kRadiusOne * (1 << layer));
    return ScaleViews(rules_.renderer->view_count(radius, rules_.demand), config_.tuning.n_scale);
  }

  void ChooseParameters(const BlockStats& stats, int32_t side, Block* block) const {
    const Rect& rect = block->rect;
    const int32_t layer = Min(rules_.renderer->layer(stats, rules_.demand), rules_.max_layer);
    block->gathers = false;
    block->layer = layer;
    block->n = Min(Views(stats.r_max, layer), rules_.max_n);
    block->rendered = LayerFrame(rect, layer);
    const Border& border = stats.border[layer];
    block->border = {
        LayerBorder(border.left, 0, layer), LayerBorder(border.right, side - rect.width, layer),
        LayerBorder(border.top, 0, layer), LayerBorder(border.bottom, side - rect.height, layer)};
    BlockWork work = rules_.renderer->measure_work(
        block->rendered, block->border, rules_.apertures[block->n], stats.content, layer);
    work.upsample = UpsampledPixels(*block);
    block->cost = PredictTime(config_.tuning.timing, work);
  }

  // Limits the rendered rectangle to the cells that must be rendered from views.
  void Shrink(Block* block) const {
    block->n = 0;
    block->rendered = BlockCells{&gathered_, block->rect, block->layer}.BoundsOf(false);
    block->border = {};
    if (block->rendered.width > 0) MeasureRendered(block);
  }

  // Chooses N and the border from the smallest blocks that contain cells to render.
  void MeasureRendered(Block* block) const {
    const int32_t layer = block->layer, scale = 1 << layer;
    const Rect& rect = block->rect;
    const int32_t left = block->rendered.x * scale, top = block->rendered.y * scale;
    const int32_t right = left + block->rendered.width * scale;
    const int32_t bottom = top + block->rendered.height * scale;
    int32_t r_max = 0;
    Border border = {0, 0, 0, 0};  // border of the rendered rectangle in pixels of the picture
    for (int32_t y = rect.y; y < rect.y + rect.height; y += kSmallestBlock) {
      for (int32_t x = rect.x; x < rect.x + rect.width; x += kSmallestBlock) {
        const PartitionCandidate& candidate =
            Candidate(0, (x - x_) / kSmallestBlock, (y - y_) / kSmallestBlock);
        if (candidate.gathered[layer] == candidate.cells) continue;
        const Border& part = candidate.stats.border[layer];
        r_max = Max(r_max, candidate.stats.r_max);
        border.left = Max(border.left, part.left - (x - left));
        border.right = Max(border.right, x + kSmallestBlock + part.right - right);
        border.top = Max(border.top, part.top - (y - top));
        border.bottom = Max(border.bottom, y + kSmallestBlock + part.bottom - bottom);
      }
    }
    block->n = Min(Views(r_max, layer), rules_.max_n);
    const auto beyond = [&](int32_t pixels) { return CeilShift(pixels, layer) + 1; };
    block->border = {beyond(border.left), beyond(border.right), beyond(border.top),
                     beyond(border.bottom)};
  }

  void EmitBlocks(int level, int32_t column, int32_t row, Block* blocks) {
    if (!Inside(level, column, row)) return;
    const PartitionCandidate& candidate = Candidate(level, column, row);
    if (candidate.best == candidate.block.cost) {
      Block& block = blocks[count_++];
      block = candidate.block;
      if (block.gathers) Shrink(&block);
      return;
    }
    for (int child = 0; child < 4; ++child) {
      EmitBlocks(level - 1, 2 * column + (child & 1), 2 * row + (child >> 1), blocks);
    }
  }

  const PartitionRules& rules_;
  const CellGrid& cells_;
  PartitionCandidate* const candidates_;
  const GatherMap& gathered_;
  const FullConfig& config_;
  const int32_t side_;  // side of a superblock, in units of the smallest blocks
  int levels_ = 0;
  const int32_t x_, y_;  // upper left corner of the superblock
  int32_t count_ = 0;
};

}  // namespace

int32_t PartitionBlock(const PartitionRules& rules, const CellGrid& cells, int32_t x, int32_t y,
                       PartitionCandidate* candidates, int16_t* samples, const GatherMap& gathered,
                       Block* blocks) {
  Partition partition(rules, cells, x, y, candidates, gathered);
  partition.Measure(samples);
  return partition.Emit(blocks);
}

}  // namespace starfocus

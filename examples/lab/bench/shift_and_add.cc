// SPDX-License-Identifier: Apache-2.0
// The loops of shift-and-add are compiled for every SIMD target of the engine.
#include "examples/lab/bench/shift_and_add.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "lib/base/transfer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "examples/lab/bench/shift_and_add.cc"
// The order matters: targets.h compiles this file again for each other SIMD target.
// clang-format off
#include "simd/targets.h"
#include "hwy/highway.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace starfocus::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<int16_t>;

static void Mix(const int16_t* a, const int16_t* b, int16_t part, size_t count, int16_t* out) {
  const D d;
  const auto second = hn::Set(d, part);
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto upper = hn::LoadU(d, a + i);
    const auto change = hn::MulFixedPoint15(hn::Sub(hn::LoadU(d, b + i), upper), second);
    hn::StoreU(hn::Add(upper, change), d, out + i);
  }
}

static void Add(const int16_t* row, int16_t part, int16_t weight, size_t count, int16_t* sums) {
  const D d;
  const auto second = hn::Set(d, part), share = hn::Set(d, weight);
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto value = hn::LoadU(d, row + i);
    if (part != 0) {
      const auto next = hn::LoadU(d, row + i + 3);
      value = hn::Add(value, hn::MulFixedPoint15(hn::Sub(next, value), second));
    }
    hn::StoreU(hn::Add(hn::LoadU(d, sums + i), hn::MulFixedPoint15(value, share)), d, sums + i);
  }
}

static const ShiftAndAdd::Loops* LoopsOfTarget() {
  static const ShiftAndAdd::Loops loops = {int(16 * hn::Lanes(D())), Mix, Add};
  return &loops;
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace starfocus::bench {

HWY_EXPORT(LoopsOfTarget);

namespace {

const ShiftAndAdd::Loops* LoopsOf(const char* target) {
  const ShiftAndAdd::Loops* loops = nullptr;
#ifdef HWY_COMPILE_ONLY_STATIC
  (void)target;
#else
  for (int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    if (std::strcmp(target, hwy::TargetName(rest & -rest)) != 0) continue;
    hwy::SetSupportedTargetsForTest(rest & -rest);
    loops = HWY_DYNAMIC_DISPATCH(LoopsOfTarget)();
    hwy::SetSupportedTargetsForTest(0);
  }
#endif
  return loops != nullptr ? loops : HWY_DYNAMIC_DISPATCH(LoopsOfTarget)();
}

constexpr double kOne = 1 << 15;

// Returns the weights of the views, which sum to at most 1. The centre view gets the remainder of
// rounding.
std::vector<int16_t> WeightsOf(int views) {
  constexpr int kSteps = 100;
  const double tangent = std::tan(starfocus::Params().theta), fall_off = 1 / (tangent * tangent);
  std::vector<double> light(size_t(views), 0.0);
  double all = 0;
  for (int j = -kSteps; j <= kSteps; ++j) {
    for (int i = -kSteps; i <= kSteps; ++i) {
      const double x = double(i) / kSteps, y = double(j) / kSteps, square = x * x + y * y;
      if (square > 1) continue;
      int nearest = 0;
      double least = 9;
      for (int k = 0; k < views; ++k) {
        double u = 0, v = 0;
        starfocus_view_position(k, &u, &v, nullptr);
        const double distance = std::hypot(u - x, v - y);
        if (distance < least) least = distance, nearest = k;
      }
      const double density = std::pow(fall_off / (square + fall_off), 2);
      light[size_t(nearest)] += density;
      all += density;
    }
  }
  std::vector<int16_t> weights;
  int rest = int(kOne) - 1;
  for (const double share : light) {
    weights.push_back(int16_t(kOne * share / all));
    rest -= weights.back();
  }
  weights[0] = int16_t(weights[0] + rest);
  return weights;
}

// Splits a shift into whole pixels and a rest.
int Split(double shift, int16_t* part) {
  int whole = int(std::floor(shift));
  const int rest = int(std::lround((shift - whole) * kOne));
  if (rest >= int(kOne)) ++whole;
  *part = int16_t(rest % int(kOne));
  return whole;
}

}  // namespace

ShiftAndAdd::ShiftAndAdd(const Field& field, int views, double focus, const std::string& target)
    : field_(field), kernels_(simd::FindKernels(target.c_str())) {
  if (kernels_ == nullptr) kernels_ = &simd::BestKernels();
  loops_ = LoopsOf(kernels_->name);
  constexpr size_t kVector = 256 / sizeof(int16_t);  // of SVE, the widest vectors
  const size_t samples = 3 * size_t(field.data.width());
  pad_ = 3 * size_t(std::ceil(std::fabs(focus)) + 2);
  const std::vector<int16_t> weights = WeightsOf(views);
  views_.resize(size_t(views));
  for (int k = 0; k < views; ++k) {
    View& view = views_[size_t(k)];
    double u = 0, v = 0;
    starfocus_view_position(k, &u, &v, nullptr);
    view.whole_x = Split(-u * focus, &view.part_x);
    view.whole_y = Split(-v * focus, &view.part_y);
    view.weight = weights[size_t(k)];
    view.decoded[0] = view.decoded[1] = -1;
    for (std::vector<int16_t>& row : view.rows) row.resize(samples + 2 * pad_ + kVector);
  }
  codes_.resize(samples + simd::kPadding);
  between_.resize(samples + 2 * pad_ + kVector);
  sums_.resize(samples + kVector);
}

// Returns the light of row y of a view. The rows above and below the view repeat its edge, as do
// the samples before and after the result.
const int16_t* ShiftAndAdd::Decoded(const Image& image, int y, View* view) {
  y = std::clamp(y, 0, image.height - 1);
  int16_t* const light = view->rows[y & 1].data() + pad_;
  if (view->decoded[y & 1] == y) return light;
  view->decoded[y & 1] = y;
  const size_t samples = image.stride();
  const uint8_t* codes = image.row(y);
  if (y == image.height - 1) {
    std::memcpy(codes_.data(), codes, samples);
    codes = codes_.data();
  }
  kernels_->Decode(codes, samples, TransferOf(field_.transfer), light);
  for (size_t i = 1; i <= pad_; ++i) light[-ptrdiff_t(i)] = light[(3 - i % 3) % 3];
  for (size_t i = 0; i < pad_; ++i) light[samples + i] = light[samples - 3 + i % 3];
  return light;
}

void ShiftAndAdd::AddView(const Image& image, int y, View* view) {
  const size_t samples = image.stride();
  const int16_t* row = Decoded(image, y + view->whole_y, view);
  if (view->part_y != 0) {
    const int16_t* const next = Decoded(image, y + view->whole_y + 1, view);
    loops_->mix(row - pad_, next - pad_, view->part_y, samples + 2 * pad_, between_.data());
    row = between_.data() + pad_;
  }
  loops_->add(row + 3 * view->whole_x, view->part_x, view->weight, samples, sums_.data());
}

void ShiftAndAdd::Run(Image* out) {
  for (View& view : views_) view.decoded[0] = view.decoded[1] = -1;
  for (int y = 0; y < out->height; ++y) {
    std::fill(sums_.begin(), sums_.end(), int16_t{0});
    for (size_t k = 0; k < views_.size(); ++k) {
      if (views_[k].weight != 0) AddView(field_.data.views[k], y, &views_[k]);
    }
    // Rounded products may exceed white.
    for (int16_t& sum : sums_) sum = std::min(sum, simd::kLightWhite);
    kernels_->Encode(sums_.data(), out->stride(), TransferOf(field_.transfer), out->row(y));
  }
}

}  // namespace starfocus::bench
#endif

// SPDX-License-Identifier: Apache-2.0
// Compares every kernel with its reference on every SIMD target of this machine. The cases of the
// kernels of simd/X.h are in X_cases.cc.
#include <doctest/doctest.h>
#include <hwy/highway.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "tests/kernels/kernel_cases.h"
#include "tests/support/inside.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace kernels_bytes_test {
namespace {

using namespace starfocus::simd;

TEST_CASE("kernels: at least two SIMD targets run on this machine") {
  const std::vector<const Kernels*> all = test::SimdTargets();
  std::printf("SIMD targets:");
  for (const Kernels* kernels : all) std::printf(" %s", kernels->name);
  std::printf("\n");
#if HWY_ARCH_X86 && !defined(HWY_COMPILE_ONLY_STATIC)
  CHECK(all.size() > 1);
#endif
}

TEST_CASE("kernels: ListTargets throws if no SIMD target runs on this machine") {
  CHECK_THROWS(test::ListTargets(+[](size_t) -> const Kernels* { return nullptr; }));
}

// Checks calls of the cases with random arguments, and the calls that the benchmark times. All
// targets must return the bits that the reference returns, and write nothing else. `targets` begins
// with the target `best`, which the engine uses.
template <class Table, class Cases>
void CheckKernels(const Cases& cases, const Table& reference, const Table& best,
                  const std::vector<const Table*>& targets) {
  constexpr int kRounds = STARFOCUS_EMULATED ? 200 : 1000;
  CHECK(targets[0] == &best);
  uint64_t seed = 0;
  for (const auto& one : cases) {
    const std::string name = one.kernel;
    CAPTURE(name);
    test::Met met, met_timed;
    const auto check = [&](test::Draw draw, test::Met* of_draw) {
      test::CallOf<Table> call(&draw);
      one.make(&draw, &call);
      const std::string wrong = call.Check(reference, targets, of_draw);
      REQUIRE_MESSAGE(wrong.empty(), wrong);
    };
    ++seed;
    for (int round = 0; round < kRounds; ++round) {
      CAPTURE(round);
      check(test::Draw::ForTest(seed, round), &met);
    }
    // Each situation in `met` must occur more than kRounds / 50 times, so that the random calls
    // test the situation.
    for (const auto& what : met) {
      CAPTURE(what.first);
      CHECK(what.second > kRounds / 50);
    }
    check(test::Draw::ForBench(), &met_timed);
    // The case must call the kernel that it is named after.
    test::Draw draw = test::Draw::ForBench();
    test::CallOf<Table> call(&draw);
    one.make(&draw, &call);
    Table replaced = reference;
    one.replace(&replaced);
    CHECK_THROWS_AS(call.run(replaced), test::KernelCalled);
  }
}

TEST_CASE("kernels: every target returns the bits of the reference and writes nothing else") {
  CheckKernels(test::kernel_cases::kAll, ReferenceKernels(), BestKernels(), test::SimdTargets());
  CheckKernels(test::line_scan_cases::kAll, ReferenceLineScanKernels(), BestLineScanKernels(),
               test::LineScanTargets());
  CheckKernels(test::depth_cases::kAll, ReferenceDepthKernels(), BestDepthKernels(),
               test::DepthTargets());
  CheckKernels(test::image_cases::kAll, ReferenceImageKernels(), BestImageKernels(),
               test::ImageTargets());
  CheckKernels(test::video_cases::kAll, ReferenceVideoKernels(), BestVideoKernels(),
               test::VideoTargets());
  CheckKernels(test::word_cases::kAll, ReferenceWordKernels(), BestWordKernels(),
               test::WordTargets());
}

TEST_CASE("kernels: on every target, HalvesToDepth converts all half floats correctly") {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<uint16_t> halves(65536);
  for (size_t k = 0; k < halves.size(); ++k) halves[k] = uint16_t(k);
  for (const ImageKernels* kernels : test::ImageTargets()) {
    std::vector<float> z(halves.size());
    kernels->HalvesToDepth(halves.data(), z.size(), z.data());
    int wrong = 0;
    for (size_t k = 0; k < z.size(); ++k) {
      const int exponent = int(k >> 10) & 31, fraction = int(k) & 1023;
      const double size =
          exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
      if (exponent == 31) {
        const bool right = fraction != 0 ? std::isnan(z[k]) : z[k] == (k >= 32768 ? -kInf : kInf);
        wrong += right ? 0 : 1;
      } else {
        wrong += double(z[k]) == (k >= 32768 ? -size : size) ? 0 : 1;
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("kernels: BlendRows and UpsampleRow interpolate known disparities on one surface only") {
  // A blend is a weighted mean if the disparities differ by at most kBlendStep, and otherwise the
  // nearer value in the picture.
  const ImageKernels& kernels = ReferenceImageKernels();
  const int16_t a[] = {0, 0, 0, kNoSurface}, b[] = {96, 97, -96, 5};
  std::vector<int16_t> out(4);
  using Row = std::vector<int16_t>;
  kernels.BlendRows(a, b, 4, 64, out.data());
  CHECK(out == Row{24, 0, -24, kNoSurface});
  kernels.BlendRows(a, b, 4, 128, out.data());
  CHECK(out == Row{48, 97, -48, 5});
  const int16_t row[] = {0, 80, 1000};
  const uint32_t columns[] = {7 * 256, 7 * 256 + 128, 8 * 256 + 127, 8 * 256 + 128};
  kernels.UpsampleRow(row, columns, 4, 7, out.data());
  CHECK(out == Row{0, 40, 80, 1000});
}

// A function that makes a call of the kernel Narrow wrong, and the start of the expected complaint.
struct Spoilt {
  const char* complaint;
  void (*spoil)(const int16_t* in, size_t count, uint8_t* out);
};
constexpr Spoilt kSpoilt[] = {
    {"spoilt differs in out[0]", [](const int16_t*, size_t, uint8_t* out) { out[0] ^= 1; }},
    // The result must not depend on the arbitrary sample after the last sample.
    {"spoilt differs in out[0]",
     [](const int16_t* in, size_t count, uint8_t* out) { out[0] = uint8_t(out[0] + in[count]); }},
    {"spoilt writes where it may not: out[",
     [](const int16_t*, size_t count, uint8_t* out) { out[count] ^= 1; }},
    {"spoilt writes where it may not: out[-1]",
     [](const int16_t*, size_t, uint8_t* out) { out[-1] ^= 1; }},
    {"spoilt writes where it may not: in[0]",
     [](const int16_t* in, size_t, uint8_t*) { const_cast<int16_t*>(in)[0] ^= 1; }},
};
const Spoilt* spoilt_now = nullptr;

// Calls kernels of `spoilt` as one case does, and returns the first complaint.
std::string Complaint(const Kernels& spoilt, void (*make)(test::Draw*, test::KernelCall*)) {
  std::string wrong;
  for (int round = 0; round < 20 && wrong.empty(); ++round) {
    test::Draw draw = test::Draw::ForTest(1, round);
    test::KernelCall call(&draw);
    make(&draw, &call);
    test::Met met;
    wrong = call.Check(ReferenceKernels(), {&spoilt}, &met);
  }
  return wrong;
}

TEST_CASE("kernels: KernelCall::Check detects wrong results and forbidden accesses") {
  Kernels spoilt = ReferenceKernels();
  spoilt.name = "spoilt";
  spoilt.Narrow = [](const int16_t* in, size_t count, const Encoding& encoding, uint8_t* out) {
    ReferenceKernels().Narrow(in, count, encoding, out);
    spoilt_now->spoil(in, count, out);
  };
  for (const Spoilt& one : kSpoilt) {
    spoilt_now = &one;
    const std::string wrong = Complaint(spoilt, test::kernel_cases::Narrow);
    CHECK_MESSAGE(wrong.find(one.complaint) == 0, wrong);
  }
  spoilt.Deinterleave = [](const int16_t* rgb, size_t count, size_t plane, int16_t* out) {
    ReferenceKernels().Deinterleave(rgb, count, plane, out);
    if (plane > count) out[count] ^= 1;  // between two planes
  };
  CHECK(Complaint(spoilt, test::kernel_cases::Deinterleave).find("spoilt writes where") == 0);
  spoilt.ConvertDisparity = [](const float* disparity, size_t count, float low, float high,
                               int16_t* out) {
    return !ReferenceKernels().ConvertDisparity(disparity, count, low, high, out);
  };
  CHECK(Complaint(spoilt, test::kernel_cases::ConvertDisparity) == "spoilt returns 0 instead of 1");
}

}  // namespace
}  // namespace kernels_bytes_test

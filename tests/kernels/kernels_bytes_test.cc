// SPDX-License-Identifier: Apache-2.0
// Compares every kernel with its reference on every SIMD target of this machine.
#include <doctest/doctest.h>
#include <hwy/highway.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

#include "simd/kernels.h"
#include "tests/kernels/check_kernels.h"
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
  CHECK(std::string(starfocus_simd_target()) == BestKernels().name);
}

TEST_CASE("kernels: ListTargets throws if no SIMD target runs on this machine") {
  CHECK_THROWS(test::ListTargets(+[](size_t) -> const Kernels* { return nullptr; }));
}

TEST_CASE("kernels: every target returns the bits of the reference and writes nothing else") {
  test::CheckKernels<test::KernelCall>(test::kernel_cases::kAll, ReferenceKernels(),
                                       test::SimdTargets());
  CHECK(test::LineScanTargets()[0] == &BestLineScanKernels());
  test::CheckKernels<test::LineScanCall>(test::line_scan_cases::kAll, ReferenceLineScanKernels(),
                                         test::LineScanTargets());
}

const Kernels& ReferenceOf(const Kernels*) { return ReferenceKernels(); }
const LineScanKernels& ReferenceOf(const LineScanKernels*) { return ReferenceLineScanKernels(); }

template <class Table, class Cases>
void CheckTimedCalls(const Cases& cases, const std::vector<const Table*>& targets) {
  for (const auto& one : cases) {
    test::Draw draw = test::Draw::ForBench();
    test::CallOf<Table> call(&draw);
    one.make(&draw, &call);
    test::Met met;
    const std::string wrong = call.Check(ReferenceOf(targets[0]), targets, &met);
    CHECK_MESSAGE(wrong.empty(), (one.kernel + (": " + wrong)));
  }
}

TEST_CASE("kernels: the timed calls of the benchmark return correct results") {
  CheckTimedCalls(test::kernel_cases::kAll, test::SimdTargets());
  CheckTimedCalls(test::line_scan_cases::kAll, test::LineScanTargets());
}

// Replaces one kernel of a table by a function that counts calls.
template <auto kKernel>
struct Counted;
template <class TableType, class Result, class... Args, Result (*TableType::*kKernel)(Args...)>
struct Counted<kKernel> {
  static inline int calls = 0;

  static Result Call(Args... args) {
    ++calls;
    return (ReferenceOf(static_cast<TableType*>(nullptr)).*kKernel)(args...);
  }
  static TableType Table() {
    TableType kernels = ReferenceOf(static_cast<TableType*>(nullptr));
    kernels.*kKernel = Call;
    return kernels;
  }
};

TEST_CASE("kernels: each case calls the kernel that it is named after") {
  const auto check = [](const auto& one, const auto& table, const int* calls) {
    test::Draw draw = test::Draw::ForBench();
    test::CallOf<std::decay_t<decltype(table)>> call(&draw);
    one.make(&draw, &call);
    call.run(table);
    CHECK_MESSAGE(*calls > 0, std::string(one.kernel));
  };
  const auto* one = test::kernel_cases::kAll;
#define STARFOCUS_COUNT_CALLS(Kernel) \
  check(*one++, Counted<&Kernels::Kernel>::Table(), &Counted<&Kernels::Kernel>::calls);
  STARFOCUS_KERNELS(STARFOCUS_COUNT_CALLS)
#undef STARFOCUS_COUNT_CALLS
  const auto* of_lines = test::line_scan_cases::kAll;
#define STARFOCUS_COUNT_CALLS(Kernel)                            \
  check(*of_lines++, Counted<&LineScanKernels::Kernel>::Table(), \
        &Counted<&LineScanKernels::Kernel>::calls);
  STARFOCUS_LINE_SCAN_KERNELS(STARFOCUS_COUNT_CALLS)
#undef STARFOCUS_COUNT_CALLS
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

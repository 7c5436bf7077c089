// SPDX-License-Identifier: Apache-2.0
// The table of kernels of one SIMD target, for the unit that includes this once for each target. It
// defines STARFOCUS_TABLE (the type of the table), STARFOCUS_LIST (the list of its kernels) and
// STARFOCUS_BEST (the function that returns the table of the best target, chosen once by Highway).
HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// HWY_NAMESPACE is N_ and the target's name.
#undef STARFOCUS_TEXT
#undef STARFOCUS_TEXT_OF
#define STARFOCUS_TEXT(name) #name
#define STARFOCUS_TEXT_OF(name) STARFOCUS_TEXT(name)

static const STARFOCUS_TABLE* Table() {
  static constexpr STARFOCUS_TABLE kernels = {&STARFOCUS_TEXT_OF(HWY_NAMESPACE)[2],
                                              STARFOCUS_LIST(STARFOCUS_ENTRY)};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace starfocus::simd {

HWY_EXPORT(Table);

const STARFOCUS_TABLE& STARFOCUS_BEST() { return *HWY_DYNAMIC_DISPATCH(Table)(); }

}  // namespace starfocus::simd
#endif

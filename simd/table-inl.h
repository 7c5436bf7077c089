// SPDX-License-Identifier: Apache-2.0
// Defines a table of kernels for the current SIMD target. For the last target, this file also
// defines Best##Table, which returns the table of the machine's best target. The unit that includes
// this file once per target defines STARFOCUS_TABLE (the type of the table) and STARFOCUS_LIST (the
// list of the table's kernels).
HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// HWY_NAMESPACE is N_ followed by the target's name.
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

#define STARFOCUS_JOIN(a, b) a##b
#define STARFOCUS_BEST(Table) STARFOCUS_JOIN(Best, Table)

const STARFOCUS_TABLE& STARFOCUS_BEST(STARFOCUS_TABLE)() { return *HWY_DYNAMIC_DISPATCH(Table)(); }

}  // namespace starfocus::simd
#endif

// SPDX-License-Identifier: Apache-2.0
// Operations for WebAssembly that Highway 1.0.3 computes with scalar code. The compiler prefers
// these overloads to the templates of Highway, also within other operations of Highway. This file
// is included once per target.
#if defined(STARFOCUS_SIMD_WASM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_WASM_INL_H_
#undef STARFOCUS_SIMD_WASM_INL_H_
#else
#define STARFOCUS_SIMD_WASM_INL_H_
#endif

#include "hwy/highway.h"

#if HWY_ARCH_WASM && HWY_TARGET != HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace hwy {
namespace HWY_NAMESPACE {

// LoadInterleaved3 and StoreInterleaved3 call these functions. An index of 16 or more selects 0.
HWY_API Vec128<uint8_t> TableLookupBytesOr0(Vec128<uint8_t> bytes, Vec128<uint8_t> from) {
  return Vec128<uint8_t>{wasm_i8x16_swizzle(bytes.raw, from.raw)};
}
HWY_API Vec128<uint16_t> TableLookupBytesOr0(Vec128<int16_t> bytes, Vec128<uint16_t> from) {
  return Vec128<uint16_t>{wasm_i8x16_swizzle(bytes.raw, from.raw)};
}

HWY_API bool AllFalse(Full128<int16_t> /* tag */, Mask128<int16_t> mask) {
  return !wasm_v128_any_true(mask.raw);
}

}  // namespace HWY_NAMESPACE
}  // namespace hwy
HWY_AFTER_NAMESPACE();

#endif

#endif

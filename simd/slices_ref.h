// The plain C++ that defines the kernels of surfaces and slices.
#ifndef STARFOCUS_SIMD_SLICES_REF_H_
#define STARFOCUS_SIMD_SLICES_REF_H_

#include "simd/kernels.h"

namespace starfocus::simd::reference {

// As those of Kernels.
void Split(const uint8_t* rgb, size_t count, size_t plane, uint8_t* out);
void FindEdges(const int16_t* near, const int16_t* far, const EdgeLimits& limits, size_t count,
               int16_t* moved, int16_t* behind, uint8_t* distance);
void FindSteps(const int16_t* row, size_t count, int16_t step, StepBits* steps);
void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                 uint16_t* beside);
uint64_t LookBehind(const DepthRow& row, const HiddenRow& hidden);
void Interpolate(const uint8_t* here, const uint8_t* next, const uint8_t* weight, size_t plane,
                 uint8_t* out);
SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count, size_t plane,
                       int16_t* out);
void SpreadSlice(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                 int16_t* out);
void ShiftSlice(const SlicePlanes& in, const SliceFraction& fraction, size_t rows, size_t plane,
                int16_t* out, uint8_t* near);
void Composite(const SliceViews& views, size_t rows, uint32_t* sums);
void FinishComposite(const uint32_t* sums, size_t plane, const uint8_t* rgb,
                     const CompositeFinish& finish, size_t count, uint32_t* out);

}  // namespace starfocus::simd::reference

#endif  // STARFOCUS_SIMD_SLICES_REF_H_

// One table of kernels per SIMD target; Highway picks the best one of the machine.
#include "simd/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels.cc"
#include "hwy/foreach_target.h"  // must precede highway.h
#include "hwy/highway.h"
#include "simd/accumulate-inl.h"
#include "simd/blend-inl.h"
#include "simd/cells-inl.h"
#include "simd/disc-inl.h"
#include "simd/finish_composite-inl.h"
#include "simd/neighbourhood-inl.h"
#include "simd/ranges-inl.h"
#include "simd/resample-inl.h"
#include "simd/runs-inl.h"
#include "simd/slices-inl.h"
#include "simd/surfaces-inl.h"
#include "simd/tiles-inl.h"
#include "simd/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

void Accumulate(const Span* spans, size_t count, uint32_t* accumulators) {
  AccumulateSpans(spans, count, accumulators);
}

void Blend(const Span* spans, size_t count, uint8_t* line) { BlendSpans(spans, count, line); }

void FilterDisc(const uint8_t* in, size_t in_stride, const Disc& disc, size_t rows, size_t count,
                uint8_t* out, size_t out_stride) {
  DiscSamples(in, in_stride, disc, rows, count, out, out_stride);
}

void Split(const uint8_t* rgb, size_t count, size_t plane, uint8_t* out) {
  SplitPixels(rgb, count, plane, out);
}

void FindEdges(const int16_t* near, const int16_t* far, const EdgeLimits& limits, size_t count,
               int16_t* moved, int16_t* behind, uint8_t* distance) {
  FindEdgesOfRow(near, far, limits, count, moved, behind, distance);
}

void FindRanges(const int16_t* disparity, size_t stride, size_t rows, size_t count,
                DisparityRange* ranges) {
  FindRangesOfRows(disparity, stride, rows, count, ranges);
}

void FindWithin(const int16_t* disparity, size_t stride, size_t rows, const DisparityRange& range,
                uint16_t* within) {
  FindWithinRows(disparity, stride, rows, range, within);
}

void FindSteps(const int16_t* row, size_t count, int16_t step, StepBits* steps) {
  FindStepsOfRow(row, count, step, steps);
}

void BesideSteps(const int16_t* row, ptrdiff_t stride, size_t count, int16_t step,
                 uint16_t* beside) {
  FindBesideSteps(row, stride, count, step, beside);
}

uint64_t LookBehind(const DepthRow& row, const HiddenRow& hidden) {
  return LookBehindRow(row, hidden);
}

void Interpolate(const uint8_t* here, const uint8_t* next, const uint8_t* weight, size_t plane,
                 uint8_t* out) {
  InterpolatePixels(here, next, weight, plane, out);
}

SliceCover SelectSlice(const SurfaceRow& row, const SliceRange& range, size_t count, size_t plane,
                       int16_t* out) {
  return SelectPixels(row, range, count, plane, out);
}

void SpreadSlice(const int16_t* in, ptrdiff_t step, const SliceTaps& taps, size_t count,
                 int16_t* out) {
  SpreadSamplesOfSlice(in, step, taps, count, out);
}

void ShiftSlice(const SlicePlanes& in, const SliceFraction& fraction, size_t rows, size_t plane,
                int16_t* out, uint8_t* near) {
  ShiftPlanes(in, fraction, rows, plane, out, near);
}

void Composite(const SliceViews& views, size_t rows, uint32_t* sums) {
  CompositeViews(views, rows, sums);
}

void FinishComposite(const uint32_t* sums, size_t plane, const uint8_t* rgb,
                     const CompositeFinish& finish, size_t count, uint32_t* out) {
  FinishPixelsOfComposite(sums, plane, rgb, finish, count, out);
}

void FindRuns(const int16_t* disparity, ptrdiff_t step, size_t length, size_t lines,
              const RunLimits& limits, const RunMarks& marks) {
  FindRunsOfLines(disparity, step, length, lines, limits, marks);
}

void MeasureCell(const int16_t* const rows[10], const CellLimits& limits, CellMeasure* measure) {
  MeasureDisparities(rows, limits, measure);
}

void ReachBlock(const CellPlanes& planes, int32_t around, const int16_t margins[3],
                BlockReach* reach) {
  ReachOneBlock(planes, around, margins, reach);
}

void SurroundCells(const CellPlanes& planes, int32_t around, size_t count,
                   const CellRanges& ranges) {
  SurroundRow(planes, around, count, ranges);
}

void Transpose(const uint8_t* in, size_t in_stride, size_t rows, size_t columns, uint8_t* out,
               size_t out_stride) {
  TransposePixels(in, in_stride, rows, columns, out, out_stride);
}

void Finish(const uint32_t* accumulators, size_t count, int shift, uint8_t* out) {
  FinishSamples(accumulators, count, shift, out);
}

bool ConvertDisparity(const float* disparity, size_t count, float low, float high, int16_t* out) {
  return ConvertDisparities(disparity, count, low, high, out);
}

void WidenPhases(const uint8_t* in, size_t pairs, int16_t* even, int16_t* odd) {
  WidenPhasesOfLine(in, pairs, even, odd);
}

void SplitPhases(const int16_t* in, size_t pairs, int16_t* even, int16_t* odd) {
  SplitPhasesOfLine(in, pairs, even, odd);
}

void Narrow(const int16_t* in, size_t count, uint8_t* out) { NarrowSamples(in, count, out); }

void FinishLayer(const uint32_t* accumulators, size_t count, int shift, int16_t* out) {
  FinishLayerSamples(accumulators, count, shift, out);
}

void FilterHalfBand(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count,
                    int16_t low, int16_t high, int16_t* out) {
  HalfBandSamples(in, step, taps, count, low, high, out);
}

void Halve(const int16_t* even, const int16_t* odd, const HalfBand& taps, size_t count,
           int16_t* out) {
  HalveLine(even, odd, taps, count, out);
}

void Between(const int16_t* in, ptrdiff_t step, const HalfBand& taps, size_t count, int16_t low,
             int16_t high, int16_t* out) {
  BetweenSamples(in, step, taps, count, low, high, out);
}

// HWY_NAMESPACE is N_ and the target's name.
#undef STARFOCUS_TEXT
#undef STARFOCUS_TEXT_OF
#define STARFOCUS_TEXT(name) #name
#define STARFOCUS_TEXT_OF(name) STARFOCUS_TEXT(name)

const Kernels* Table() {
  static constexpr Kernels kernels = {&STARFOCUS_TEXT_OF(HWY_NAMESPACE)[2],
                                      Accumulate,
                                      Blend,
                                      FilterDisc,
                                      Split,
                                      FindEdges,
                                      FindRanges,
                                      FindWithin,
                                      FindSteps,
                                      BesideSteps,
                                      LookBehind,
                                      Interpolate,
                                      SelectSlice,
                                      SpreadSlice,
                                      ShiftSlice,
                                      Composite,
                                      FinishComposite,
                                      FindRuns,
                                      MeasureCell,
                                      ReachBlock,
                                      SurroundCells,
                                      Transpose,
                                      Finish,
                                      ConvertDisparity,
                                      WidenPhases,
                                      SplitPhases,
                                      Narrow,
                                      FinishLayer,
                                      FilterHalfBand,
                                      Halve,
                                      Between};
  return &kernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace starfocus::simd {

HWY_EXPORT(Table);

const Kernels& BestKernels() { return *HWY_DYNAMIC_DISPATCH(Table)(); }

}  // namespace starfocus::simd
#endif

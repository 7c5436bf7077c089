// SPDX-License-Identifier: Apache-2.0
// Functions that call the C ABI and write rows of R, G, B.
#ifndef STARFOCUS_TESTS_SUPPORT_RGB_CALLS_H_
#define STARFOCUS_TESTS_SUPPORT_RGB_CALLS_H_

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace test {

inline starfocus_status RefocusRgb(starfocus_engine* engine, const starfocus_params* params,
                                   const starfocus_light_field* field, uint8_t* out, size_t stride,
                                   starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return starfocus_refocus(engine, params, field, &image, report);
}

inline starfocus_status RefocusAfterRgb(starfocus_engine* engine, const starfocus_params* params,
                                        const starfocus_light_field* field,
                                        const starfocus_previous* previous, uint8_t* out,
                                        size_t stride, starfocus_report* report) {
  starfocus::Params after(*params);
  after.previous = previous;
  return RefocusRgb(engine, &after, field, out, stride, report);
}

inline starfocus_status RefocusPreparedRgb(starfocus_engine* engine, const starfocus_params* params,
                                           const starfocus_prepared* prepared, uint8_t* out,
                                           size_t stride, starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return starfocus_refocus_prepared(engine, params, prepared, &image, report);
}

inline starfocus_status Preview(starfocus_engine* engine, const starfocus_params* params,
                                const starfocus_prepared* prepared, int32_t shift,
                                const starfocus_image* out, starfocus_report* report) {
  starfocus::Params reduced(*params);
  reduced.preview_shift = shift;
  return starfocus_refocus_prepared(engine, &reduced, prepared, out, report);
}

inline starfocus_status PreviewRgb(starfocus_engine* engine, const starfocus_params* params,
                                   const starfocus_prepared* prepared, int32_t shift, uint8_t* out,
                                   size_t stride, starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return Preview(engine, params, prepared, shift, &image, report);
}

inline starfocus_status PullRgb(starfocus_engine* engine, uint8_t* out, size_t stride, int32_t rows,
                                int32_t* written, starfocus_report* report) {
  const starfocus_image image = starfocus_image_rgb(out, stride);
  return starfocus_stream_pull(engine, &image, rows, written, report);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_RGB_CALLS_H_

// SPDX-License-Identifier: Apache-2.0
// The calls of the C ABI with rows of R, G, B as outputs.
#ifndef STARFOCUS_TESTS_SUPPORT_RGB_CALLS_H_
#define STARFOCUS_TESTS_SUPPORT_RGB_CALLS_H_

#include "starfocus/starfocus.h"

namespace test {

inline sf_status RefocusRgb(sf_engine* engine, const sf_params* params, const sf_light_field* field,
                            uint8_t* out, size_t stride, sf_report* report) {
  const sf_image image = sf_image_rgb(out, stride);
  return sf_refocus(engine, params, field, &image, report);
}

inline sf_status RefocusAfterRgb(sf_engine* engine, const sf_params* params,
                                 const sf_light_field* field, const sf_previous* previous,
                                 uint8_t* out, size_t stride, sf_report* report) {
  sf_params after = *params;
  after.previous = previous;
  return RefocusRgb(engine, &after, field, out, stride, report);
}

inline sf_status RefocusPreparedRgb(sf_engine* engine, const sf_params* params,
                                    const sf_prepared* prepared, uint8_t* out, size_t stride,
                                    sf_report* report) {
  const sf_image image = sf_image_rgb(out, stride);
  return sf_refocus_prepared(engine, params, prepared, &image, report);
}

inline sf_status Preview(sf_engine* engine, const sf_params* params, const sf_prepared* prepared,
                         int32_t shift, const sf_image* out, sf_report* report) {
  sf_params reduced = *params;
  reduced.preview_shift = shift;
  return sf_refocus_prepared(engine, &reduced, prepared, out, report);
}

inline sf_status PreviewRgb(sf_engine* engine, const sf_params* params, const sf_prepared* prepared,
                            int32_t shift, uint8_t* out, size_t stride, sf_report* report) {
  const sf_image image = sf_image_rgb(out, stride);
  return Preview(engine, params, prepared, shift, &image, report);
}

inline sf_status PullRgb(sf_engine* engine, uint8_t* out, size_t stride, int32_t rows,
                         int32_t* written, sf_report* report) {
  const sf_image image = sf_image_rgb(out, stride);
  return sf_stream_pull(engine, &image, rows, written, report);
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_RGB_CALLS_H_

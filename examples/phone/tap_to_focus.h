/* SPDX-License-Identifier: Apache-2.0 */
/* Tap to focus: refocuses a frame of a camera at the pixel that a user tapped. Used by phone.c. */
#ifndef STARFOCUS_EXAMPLES_PHONE_TAP_TO_FOCUS_H_
#define STARFOCUS_EXAMPLES_PHONE_TAP_TO_FOCUS_H_

#include <starfocus/starfocus.h>

/** A frame of a camera with a depth sensor. Rows have no padding. */
typedef struct Frame {
  int32_t width, height;       /**< Size of the picture in pixels, multiples of 4. */
  uint8_t *luma, *chroma;      /**< NV12 in limited range. */
  const uint16_t* millimetres; /**< Distances at 1/4 of the width and height; 0: unknown. */
} Frame;

/** Refocuses a frame, with the largest aperture whose blur radius is at most 32 pixels.
 *  @param frame frame to refocus
 *  @param x,y tapped pixel
 *  @param out luma and chroma of the picture, in the layout of the frame
 *  @return STARFOCUS_OK, or the status of the call that failed */
starfocus_status TapToFocus(const Frame* frame, int32_t x, int32_t y, uint8_t* out[2]);

#endif /* STARFOCUS_EXAMPLES_PHONE_TAP_TO_FOCUS_H_ */

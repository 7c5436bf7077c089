/* SPDX-License-Identifier: Apache-2.0 */
/* Simulates five cameras that look at a ball in front of a wall, and a depth sensor with fewer
 * pixels. The simulation computes rows of pixels on request. Used by camera.c. */
#ifndef STARFOCUS_EXAMPLES_CAMERA_SENSOR_H_
#define STARFOCUS_EXAMPLES_CAMERA_SENSOR_H_

#include <stdint.h>

/** Sizes of the pictures and of the depth map in pixels, and number of cameras. */
enum { kWidth = 4000, kHeight = 3000, kCameras = 5, kDepthWidth = 1000, kDepthHeight = 750 };
/** Disparities of the ball and the wall in pixels. */
enum { kBall = 24, kWall = -6 };

/** Writes rows [first, first + rows) of a camera as NV12 in limited range.
 *  @param camera index of the camera, [0, kCameras)
 *  @param first first row, even
 *  @param rows number of rows, even
 *  @param luma receives `rows` rows of kWidth bytes
 *  @param chroma receives `rows` / 2 rows of kWidth bytes */
void SensorRows(int camera, int first, int rows, uint8_t* luma, uint8_t* chroma);

/** Writes the depth map of the first camera: kDepthHeight rows of kDepthWidth values. Each value is
 * a disparity plus 100.
 */
void SensorDepth(uint8_t* map);

#endif /* STARFOCUS_EXAMPLES_CAMERA_SENSOR_H_ */

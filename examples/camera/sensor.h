/* SPDX-License-Identifier: Apache-2.0 */
/* Five cameras that look at a ball before a wall, and a smaller depth sensor: what they deliver is
 * made up, row by row, as it is asked for. */
#ifndef STARFOCUS_EXAMPLES_CAMERA_SENSOR_H_
#define STARFOCUS_EXAMPLES_CAMERA_SENSOR_H_

#include <stdint.h>

/** Size of the pictures and of the depth map, in pixels; disparities of the ball and the wall. */
enum { kWidth = 4000, kHeight = 3000, kCameras = 5, kDepthWidth = 1000, kDepthHeight = 750 };
enum { kBall = 24, kWall = -6 };

/** Writes rows `first` to `first + rows` of what `camera` sees as NV12, limited range: luma and the
 *  chroma of every second row, each kWidth bytes long. `first` and `rows` are even. */
void SensorRows(int camera, int first, int rows, uint8_t* luma, uint8_t* chroma);

/** Writes the depth map of the first camera: disparities, plus 100. */
void SensorDepth(uint8_t* map);

#endif /* STARFOCUS_EXAMPLES_CAMERA_SENSOR_H_ */

/* SPDX-License-Identifier: Apache-2.0 */
#include "sensor.h"

#include <starfocus/starfocus.h>

/* Returns 1 if the first camera sees the ball at pixel (x, y), otherwise 0. */
static int IsBall(int x, int y) {
  const int dx = x - kWidth / 2, dy = y - kHeight / 2;
  return dx * dx + dy * dy < kHeight / 3 * (kHeight / 3);
}

/* Finds the texture coordinates of the surface that the camera at (u, v) sees at pixel (x, y).
 * Texture coordinates are the coordinates at which the first camera sees the surface point, plus
 * 1024 to keep them positive. Returns 1 for the ball, 0 for the wall. */
static int SeenByFirst(int x, int y, int u, int v, int* seen_x, int* seen_y) {
  const int is_ball = IsBall(x + u * kBall, y + v * kBall);
  const int disparity = is_ball ? kBall : kWall;
  *seen_x = x + u * disparity + 1024;
  *seen_y = y + v * disparity + 1024;
  return is_ball;
}

/* Returns the luma of a pixel: chequers on the ball, or stripes and white tiles on the wall. Noise
 * is part of both surfaces, so all cameras see the same noise at a surface point. */
static uint8_t LumaAt(int x, int y, int u, int v) {
  int seen_x, seen_y, grain;
  const int is_ball = SeenByFirst(x, y, u, v, &seen_x, &seen_y);
  grain = (int)(((unsigned)seen_x * 2654435761u ^ (unsigned)seen_y * 2246822519u) >> 28);
  if (is_ball) return (uint8_t)(((seen_x / 50 + seen_y / 50) % 2 ? 60 : 180) + grain);
  if (seen_x % 200 < 12 && seen_y % 160 < 12) return 235;
  return (uint8_t)(60 + (seen_x / 40 + seen_y / 90) % 5 * 20 + grain);
}

void SensorRows(int camera, int first, int rows, uint8_t* luma, uint8_t* chroma) {
  double place_u = 0, place_v = 0;
  int u, v, x, y;
  starfocus_view_position(camera, &place_u, &place_v, NULL);
  u = (int)place_u;
  v = (int)place_v;
  for (y = first; y < first + rows; ++y) {
    for (x = 0; x < kWidth; ++x) *luma++ = LumaAt(x, y, u, v);
  }
  for (y = first; y < first + rows; y += 2) {
    for (x = 0; x < kWidth; x += 2) {
      const int is_ball = IsBall(x + u * kBall, y + v * kBall);
      *chroma++ = is_ball ? 100 : 150;
      *chroma++ = is_ball ? 160 : 120;
    }
  }
}

void SensorDepth(uint8_t* map) {
  const int step = kWidth / kDepthWidth;
  int x, y;
  for (y = 0; y < kDepthHeight; ++y) {
    for (x = 0; x < kDepthWidth; ++x) {
      *map++ = (uint8_t)(100 + (IsBall(x * step + step / 2, y * step + step / 2) ? kBall : kWall));
    }
  }
}

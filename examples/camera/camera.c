/* SPDX-License-Identifier: Apache-2.0 */
/* usage: camera OUT.ppm
 * Refocuses a light field of five views of 12 megapixels as a stream. Five simulated sensors
 * deliver NV12 rows, and the program writes RGB rows. No picture is stored as a whole, so the
 * process uses less than 64 MiB. Prints the time and the peak memory. */
#define _POSIX_C_SOURCE 200112L
#include <starfocus/pool.h>
#include <starfocus/starfocus.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "sensor.h"

enum { kRows = 16 }; /* number of rows that a sensor delivers at a time, and that one pull takes */

static uint8_t depth[kDepthWidth * kDepthHeight];
static uint8_t luma[kCameras][kRows * kWidth], chroma[kCameras][kRows / 2 * kWidth];
static uint8_t out[kRows * kWidth * 3];
static uint32_t checksum = 2166136261u; /* FNV-1a of the output */

static double Seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static starfocus_status MakeEngine(starfocus_pool* pool, starfocus_engine** engine) {
  starfocus_callbacks callbacks = {0};
  starfocus_config config;
  starfocus_status status;
  starfocus_config_init(&config);
  config.width = kWidth, config.height = kHeight, config.views = kCameras;
  config.disparity_min = kWall, config.disparity_max = kBall, config.max_blur = kBall - kWall;
  config.features |= STARFOCUS_FEATURE_STREAMING, config.features |= STARFOCUS_FEATURE_IMAGES;
  config.superblock = 64; /* the default, 128, requires twice the memory per worker */
  config.max_workers = starfocus_pool_workers(pool);
  callbacks.runner = starfocus_pool_run, callbacks.runner_data = pool;
  status = starfocus_create(&config, NULL, engine, NULL);
  return status == STARFOCUS_OK ? starfocus_set_callbacks(*engine, &callbacks) : status;
}

/* Returns the delivered rows of all views, starting at row `first` of the buffers, and the whole
 * depth map. */
static starfocus_light_field FieldFrom(int first) {
  starfocus_light_field field;
  int i;
  starfocus_light_field_init(&field);
  for (i = 0; i < kCameras; ++i) {
    starfocus_image* const view = &field.views[i];
    view->format = STARFOCUS_FORMAT_NV12;
    view->planes[0] = luma[i] + first * kWidth, view->planes[1] = chroma[i] + first / 2 * kWidth;
    view->strides[0] = view->strides[1] = kWidth;
  }
  field.depth.data = depth, field.depth.stride = kDepthWidth;
  field.depth.width = kDepthWidth, field.depth.height = kDepthHeight;
  field.depth.type = STARFOCUS_DEPTH_U8, field.depth.scale = 1, field.depth.offset = -100;
  return field;
}

/* Pushes the delivered rows of the sensors to the engine, as many as the engine accepts at a time.
 * Writes finished rows to `file`. */
static starfocus_status Stream(starfocus_engine* engine, FILE* file, double* sensor_seconds) {
  int delivered = 0, taken = 0, written = 0;
  starfocus_status status = STARFOCUS_OK;
  while (status == STARFOCUS_OK && written < kHeight) {
    int32_t count = 0;
    if (taken == delivered && delivered < kHeight) {
      const int rows = kHeight - delivered < kRows ? kHeight - delivered : kRows;
      const double start = Seconds();
      int i;
      for (i = 0; i < kCameras; ++i) SensorRows(i, delivered, rows, luma[i], chroma[i]);
      *sensor_seconds += Seconds() - start;
      delivered += rows;
    }
    if (taken < delivered) {
      const int first = taken % kRows;
      const starfocus_light_field field = FieldFrom(first);
      status = starfocus_stream_push(engine, &field, delivered - taken, &count);
      taken += count;
    }
    if (status == STARFOCUS_OK) {
      const int rows = kHeight - written < kRows ? kHeight - written : kRows;
      const starfocus_image picture = starfocus_image_rgb(out, kWidth * 3);
      int32_t i;
      status = starfocus_stream_pull(engine, &picture, rows, &count, NULL);
      for (i = 0; i < count * kWidth * 3; ++i) checksum = (checksum ^ out[i]) * 16777619u;
      if (fwrite(out, kWidth * 3, (size_t)count, file) != (size_t)count) break;
      written += count;
    }
  }
  return status;
}

static starfocus_status Refocus(starfocus_pool* pool, FILE* file, double* sensor_seconds) {
  starfocus_engine* engine = NULL;
  starfocus_params params;
  starfocus_status status = MakeEngine(pool, &engine);
  starfocus_params_init(&params);
  params.focus = kBall;
  if (status == STARFOCUS_OK) status = starfocus_stream_begin(engine, &params);
  fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
  SensorDepth(depth);
  if (status == STARFOCUS_OK) status = Stream(engine, file, sensor_seconds);
  starfocus_destroy(engine);
  return status;
}

int main(int count, char** arguments) {
  const int32_t cores = starfocus_pool_cores();
  const double start = Seconds();
  double sensor_seconds = 0, seconds;
  struct rusage usage;
  starfocus_status status;
  starfocus_pool* pool;
  int failed;
  FILE* const file = count == 2 ? fopen(arguments[1], "wb") : NULL;
  if (!file) return fprintf(stderr, "usage: camera OUT.ppm\n"), 2;
  pool = starfocus_pool_create(cores < 4 ? cores : 4);
  status = pool ? Refocus(pool, file, &sensor_seconds) : STARFOCUS_ERROR_MEMORY;
  seconds = Seconds() - start;
  failed = ferror(file);
  failed |= fclose(file);
  getrusage(RUSAGE_SELF, &usage);
  printf("%d x %d, %d views: %.2f s, of which the sensors took %.2f s\n", kWidth, kHeight, kCameras,
         seconds, sensor_seconds);
  printf("peak memory %.1f MiB, checksum %08x\n", (double)usage.ru_maxrss / 1024,
         (unsigned)checksum);
  if (status != STARFOCUS_OK) fprintf(stderr, "camera: %s\n", starfocus_status_string(status));
  if (failed) fprintf(stderr, "camera: '%s' could not be written\n", arguments[1]);
  starfocus_pool_destroy(pool);
  return status != STARFOCUS_OK || failed;
}

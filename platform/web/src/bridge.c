/* SPDX-License-Identifier: Apache-2.0 */
/* Exports the functions that worker.js calls. A module has one engine and one light field. The
 * memory after the data of the module contains, in this order: stacks of the helpers, light field,
 * prepared light field, workspace of the engine. The engine can be replaced without changing the
 * light field. */
#include <string.h>

#include "platform/web/src/threads.h"
#include "starfocus/depth.h"
#include "starfocus/experimental.h"
#include "starfocus/matte.h"
#include "starfocus/starfocus.h"

#define EXPORT(name) __attribute__((export_name(#name)))
#define PAGE 65536u
#define MAX_BLOCKS 65536
#define STACK (2 * PAGE) /* stack size of a helper in bytes */
#define HAS_COVERAGE 1   /* flags of Room */
#define REPAIR 2
#define ESTIMATE 4

extern unsigned char __heap_base; /* end of the module's data; defined by the linker */

static char text[64];                    /* field name, written by JavaScript */
static starfocus_problem problem;        /* problem of the last call without an engine */
static const starfocus_problem* refused; /* problem of the last call */
static starfocus_config wanted;          /* configuration that is being set */
static starfocus_config config;          /* configuration of the light field and the engine */
static starfocus_config previous;        /* configuration before the last call of Accept */
static starfocus_tuning wanted_tuning, tuning,
    previous_tuning; /* tunings of these configurations */
static starfocus_params params;
static starfocus_study study; /* mode and renderer of `params` */
static starfocus_engine* engine;
static int32_t workers;
static uintptr_t top = (uintptr_t)&__heap_base; /* first unused byte */
static uintptr_t stacks_end;                    /* end of the stacks; 0 before Room is called */
static uintptr_t field_end;                     /* end of the light field */
static starfocus_light_field field;
static starfocus_disparity_output made;
static starfocus_matte matte;
static void* prepared_memory;
static size_t prepared_bytes;
static starfocus_prepared* prepared;
static uint8_t* picture;
static int32_t width, height; /* size of the last picture */
static starfocus_block* blocks;
static int32_t block_count;
static int32_t call; /* number of the running call */

/* Memory that JavaScript reads and writes during a call: `cancelled` is the number of the call to
 * cancel, and `rows_done` of `rows` rows are finished. */
static struct { int32_t cancelled, rows_done, rows; } shared;
static int32_t rows_before, rows_after; /* rows of the steps before and after the current step */

/* Returns memory aligned to STARFOCUS_ALIGNMENT, or null if the module's memory cannot grow. */
static void* Allocate(size_t bytes) {
  const uintptr_t start = (top + STARFOCUS_ALIGNMENT - 1) & ~(uintptr_t)(STARFOCUS_ALIGNMENT - 1);
  if (bytes > UINTPTR_MAX - start - PAGE) return NULL;
  const uintptr_t end = start + bytes;
  const size_t pages = (end + PAGE - 1) / PAGE, there = __builtin_wasm_memory_size(0);
  if (pages > there && __builtin_wasm_memory_grow(0, pages - there) == SIZE_MAX) return NULL;
  top = end;
  return (void*)start;
}

static int Progress(void* data, int32_t rows_done, int32_t rows) {
  (void)data;
  __atomic_store_n(&shared.rows_done, rows_before + rows_done, __ATOMIC_RELAXED);
  __atomic_store_n(&shared.rows, rows_before + rows + rows_after, __ATOMIC_RELAXED);
  return __atomic_load_n(&shared.cancelled, __ATOMIC_RELAXED) == call;
}

static void KeepBlock(void* data, const starfocus_block* block) {
  (void)data;
  if (block_count < MAX_BLOCKS) blocks[block_count++] = *block;
}

static starfocus_callbacks Callbacks(const starfocus_observer* observer) {
  return (starfocus_callbacks){
      .runner = workers > 1 ? RunOnWorkers : NULL, .progress = Progress, .observer = observer};
}

/* Sets the callbacks of the engine. `observer` may be null. No-op without an engine. */
static void SetCallbacks(const starfocus_observer* observer) {
  const starfocus_callbacks callbacks = Callbacks(observer);
  starfocus_set_callbacks(engine, &callbacks);
}

/* Returns the buffer for the name of a field: at most 63 bytes and a terminating 0. */
EXPORT(text) char* Text(void) { return text; }

/* Returns `value`, or `wrong` if it is not an integer in [low, high]. `wrong` is outside the valid
 * range of every field, so the library rejects it. */
static int64_t Whole(double value, int64_t low, int64_t high, int64_t wrong) {
  if (!(value >= (double)low && value <= (double)high)) return wrong;
  const int64_t whole = (int64_t)value;
  return (double)whole == value ? whole : wrong;
}

/* Returns 0 if a number cannot be stored as this type. */
static int Store(void* to, int32_t type, double value) {
  switch (type) {
    case STARFOCUS_FIELD_INT32:
      *(int32_t*)to = (int32_t)Whole(value, INT32_MIN, INT32_MAX, INT32_MIN);
      return 1;
    case STARFOCUS_FIELD_UINT32:
      *(uint32_t*)to = (uint32_t)Whole(value, 0, UINT32_MAX, UINT32_MAX);
      return 1;
    case STARFOCUS_FIELD_DOUBLE:
      *(double*)to = value;
      return 1;
    default:
      return 0;
  }
}

/* Sets the field `name` of a structure, for example "max_blur" of "starfocus_config" or
 * "timing.block" of "starfocus_tuning". If `value` does not fit an integer field, the field gets a
 * value that the library rejects. Returns 1, or 0 if the structure has no number `name`. */
static int SetField(const char* structure, void* to, const char* name, double value) {
  const starfocus_field* fields = NULL;
  int32_t count = 0;
  starfocus_fields(structure, &fields, &count);
  for (int32_t i = 0; i < count; ++i) {
    const size_t length = strlen(fields[i].name);
    if (strncmp(fields[i].name, name, length) != 0) continue;
    char* const at = (char*)to + fields[i].offset;
    if (name[length] == 0) return Store(at, fields[i].type, value);
    if (name[length] == '.' && fields[i].type == STARFOCUS_FIELD_STRUCTURE) {
      return SetField(fields[i].structure, at, name + length + 1, value);
    }
  }
  return 0;
}

/* Starts a change of the configuration. The initial values are copied from the last accepted
 * configuration, or are the defaults if no configuration was accepted. */
EXPORT(begin) void Begin(void) {
  if (workers == 0) {
    starfocus_config_init(&wanted);
    starfocus_tuning_init(&wanted_tuning);
    wanted_tuning.line_scan = starfocus_line_scan_renderer();
  } else {
    wanted = config;
    wanted_tuning = tuning;
  }
  wanted.tuning = &wanted_tuning;
}

/* Sets the field of starfocus_config or starfocus_tuning that `text` names, or `fill_unknown` or
 * `shapes`. Returns 0 if there is no such field. */
EXPORT(configure) int Configure(double value) {
  if (strcmp(text, "fill_unknown") == 0) {
    wanted.unknown = value != 0 ? STARFOCUS_UNKNOWN_FILL : STARFOCUS_UNKNOWN_REFUSE;
    return 1;
  }
  if (strcmp(text, "shapes") == 0) {
    wanted.features &= ~STARFOCUS_FEATURE_SHAPES;
    if (value != 0) wanted.features |= STARFOCUS_FEATURE_SHAPES;
    return 1;
  }
  return SetField("starfocus_config", &wanted, text, value) ||
         SetField("starfocus_tuning", &wanted_tuning, text, value);
}

/* Returns the positions of the configuration that is being set: u and v of each view. */
EXPORT(positions) double* Positions(void) { return &wanted.positions[0].u; }

/* Checks the configuration that was set. If it is valid, makes it the current configuration, with
 * `count` workers. On error, the current configuration remains. */
EXPORT(accept) starfocus_status Accept(int32_t count) {
  wanted.max_workers = count;
  wanted.features |= STARFOCUS_FEATURE_IMAGES;
  size_t bytes = 0;
  const starfocus_status status = starfocus_workspace_size(&wanted, &bytes, &problem);
  refused = &problem;
  if (status == STARFOCUS_OK) {
    previous = config;
    previous_tuning = tuning;
    config = wanted;
    tuning = wanted_tuning;
    config.tuning = &tuning;
    workers = count;
    SetHelpers(count - 1);
  }
  return status;
}

/* Restores the configuration before the last call of Accept. */
EXPORT(restore) void Restore(void) {
  config = previous;
  tuning = previous_tuning;
}

/* Allocates the stack of a helper. Must be called before the first call of Room. Returns the end of
 * the stack, from which the stack grows downwards, or 0 if there is no memory. */
EXPORT(stack) uintptr_t Stack(void) {
  char* const memory = (char*)Allocate(STACK);
  return memory == NULL ? 0 : (uintptr_t)(memory + STACK);
}

EXPORT(help) void HelpAs(int32_t worker) { Help(worker); }

static int MakeRoomForViews(int32_t pixel_bytes) {
  const size_t row = (size_t)pixel_bytes * (size_t)config.width;
  for (int32_t view = 0; view < config.views; ++view) {
    starfocus_image* const image = &field.views[view];
    image->format = pixel_bytes == 4 ? STARFOCUS_FORMAT_RGBX : STARFOCUS_FORMAT_RGB;
    image->planes[0] = (uint8_t*)Allocate(row * (size_t)config.height);
    image->strides[0] = row;
    if (image->planes[0] == NULL) return 0;
  }
  return 1;
}

static void MakeDepth(float* data, int32_t depth_width, int32_t depth_height) {
  field.depth =
      starfocus_depth_float(data, sizeof(float) * (size_t)depth_width, depth_width, depth_height);
}

static int MakeRoomForDepth(int32_t depth_width, int32_t depth_height) {
  float* const data = (float*)Allocate(sizeof(float) * (size_t)depth_width * (size_t)depth_height);
  MakeDepth(data, depth_width, depth_height);
  return data != NULL;
}

static int MakeRoomForCoverage(void) {
  field.coverage_stride = (size_t)config.width;
  field.coverage = (uint8_t*)Allocate(field.coverage_stride * (size_t)config.height);
  return field.coverage != NULL;
}

/* Allocates memory for a map that Repair or Estimate makes, and for its coverage or confidence. */
static int MakeRoomForMap(int32_t flags) {
  const size_t row = (size_t)config.width, rows = (size_t)config.height;
  memset(&made, 0, sizeof(made));
  made.disparity_stride = sizeof(float) * row;
  made.disparity = (float*)Allocate(made.disparity_stride * rows);
  uint8_t* const levels = (uint8_t*)Allocate(row * rows);
  made.coverage_stride = made.confidence_stride = row;
  made.coverage = (flags & REPAIR) != 0 ? levels : NULL;
  made.confidence = (flags & REPAIR) != 0 ? NULL : levels;
  return made.disparity != NULL && levels != NULL;
}

/* Creates an engine with the current configuration in the memory after the light field. Replaces
 * the previous engine. */
EXPORT(make_engine) starfocus_status MakeEngine(void) {
  size_t bytes = 0;
  const starfocus_status status = starfocus_workspace_size(&config, &bytes, &problem);
  refused = &problem;
  if (status != STARFOCUS_OK) return status;
  engine = NULL;
  top = field_end;
  void* const workspace = Allocate(bytes);
  if (workspace == NULL) return STARFOCUS_ERROR_MEMORY;
  const starfocus_status created = starfocus_init(&config, workspace, bytes, &engine, &problem);
  if (created == STARFOCUS_OK) SetCallbacks(NULL);
  return created;
}

/* Allocates memory for a light field: views with `pixel_bytes` (3 or 4) bytes per pixel, a depth
 * map, coverage if `flags` contains HAS_COVERAGE, and the results of Repair or Estimate if `flags`
 * contains REPAIR or ESTIMATE. With ESTIMATE, no pictures can be refocused. Frees the previous
 * light field and the engine. */
EXPORT(room)
starfocus_status Room(int32_t pixel_bytes, int32_t depth_width, int32_t depth_height,
                      int32_t flags) {
  if (stacks_end == 0) stacks_end = top;
  top = stacks_end;
  engine = NULL;
  prepared = NULL;
  starfocus_light_field_init(&field);
  if (!MakeRoomForViews(pixel_bytes) || !MakeRoomForDepth(depth_width, depth_height) ||
      ((flags & HAS_COVERAGE) != 0 && !MakeRoomForCoverage()) ||
      ((flags & (REPAIR | ESTIMATE)) != 0 && !MakeRoomForMap(flags))) {
    return STARFOCUS_ERROR_MEMORY;
  }
  field_end = top;
  if ((flags & ESTIMATE) != 0) return STARFOCUS_OK;
  refused = &problem;
  const starfocus_status status = starfocus_prepared_size(&config, &prepared_bytes, &problem);
  if (status != STARFOCUS_OK) return status;
  picture = (uint8_t*)Allocate(4 * (size_t)config.width * (size_t)config.height);
  blocks = (starfocus_block*)Allocate(MAX_BLOCKS * sizeof(starfocus_block));
  prepared_memory = Allocate(prepared_bytes);
  field_end = top;
  return picture != NULL && blocks != NULL && prepared_memory != NULL ? STARFOCUS_OK
                                                                      : STARFOCUS_ERROR_MEMORY;
}

/* Estimates or repairs (`repairs` is 1) a map from the views, which are packed RGB, and replaces
 * the map of the light field. The workspace lies where the engine will be. */
static starfocus_status MakeMap(int32_t repairs) {
  starfocus_config map = config;
  map.features = 0;
  const starfocus_callbacks callbacks = Callbacks(NULL);
  size_t bytes = 0;
  refused = &problem;
  starfocus_status status = starfocus_map_workspace_size(&map, repairs, &bytes, &problem);
  if (status != STARFOCUS_OK) return status;
  engine = NULL;
  top = field_end;
  void* const workspace = Allocate(bytes);
  if (workspace == NULL) return STARFOCUS_ERROR_MEMORY;
  status = (repairs ? starfocus_repair_disparity : starfocus_estimate_disparity)(
      &map, &callbacks, &field, &made, workspace, bytes, &problem);
  if (status == STARFOCUS_OK) MakeDepth(made.disparity, config.width, config.height);
  return status;
}

/* Repairs the depth map of the light field. Replaces the map, and the coverage unless the light
 * field has coverage. */
EXPORT(repair) starfocus_status Repair(void) {
  rows_after = config.height; /* of Prepare */
  if (field.coverage != NULL) made.coverage = NULL;
  const starfocus_status status = MakeMap(1);
  rows_after = 0;
  if (status != STARFOCUS_OK) return status;
  rows_before = config.height;
  if (made.has_coverage) {
    field.coverage = made.coverage;
    field.coverage_stride = made.coverage_stride;
  }
  return STARFOCUS_OK;
}

/* Allocates memory for a matte of `matte_width` x `matte_height` bytes, which is valid until the
 * next call of Repair or MakeEngine. Frees the engine. Returns the address, or null if there is no
 * memory. */
EXPORT(matte_room) const uint8_t* MakeRoomForMatte(int32_t matte_width, int32_t matte_height) {
  engine = NULL;
  top = field_end;
  matte.data = (uint8_t*)Allocate((size_t)matte_width * (size_t)matte_height);
  matte.stride = (size_t)matte_width;
  matte.width = matte_width;
  matte.height = matte_height;
  return matte.data;
}

/* Fills the map and the coverage of the light field from the matte. The background has disparity 0
 * and, if `floor` is 1, comes nearer towards the lower edge of the picture. */
EXPORT(fill_surfaces) starfocus_status FillSurfaces(double subject, int32_t floor) {
  starfocus_disparity_output out = {.disparity = (float*)field.depth.data,
                                    .disparity_stride = field.depth.stride,
                                    .coverage = (uint8_t*)field.coverage,
                                    .coverage_stride = field.coverage_stride};
  starfocus_matte_depth depth = {.subject = subject};
  refused = &problem;
  if (floor != 0) {
    starfocus_matte_stats stats;
    const starfocus_status status = starfocus_measure_matte(&matte, &stats, &problem);
    if (status != STARFOCUS_OK) return status;
    depth.horizon = stats.horizon;
    depth.ground = stats.ground;
  }
  return starfocus_matte_field(&matte, &depth, config.width, config.height, NULL, &out, &problem);
}

/* Computes the coverage of the light field from the matte and the map, which is final. Replaces the
 * coverage that Repair estimated. */
EXPORT(cover) starfocus_status Cover(void) {
  if (field.coverage == NULL) {
    field.coverage = made.coverage;
    field.coverage_stride = made.coverage_stride;
  }
  starfocus_disparity_output out = {.coverage = (uint8_t*)field.coverage,
                                    .coverage_stride = field.coverage_stride};
  refused = &problem;
  return starfocus_matte_coverage(&matte, &field.depth, config.width, config.height, NULL, &out,
                                  &problem);
}

/* Estimates the depth map of the light field and its confidence. */
EXPORT(estimate) starfocus_status Estimate(void) { return MakeMap(0); }

/* Returns the memory of the pixels of a view, of the depth map (view -1), of coverage (view -2) or
 * of the confidence of an estimate (view -3). */
EXPORT(place) const void* Place(int32_t view) {
  if (view == -3) return made.confidence;
  if (view == -2) return field.coverage;
  return view < 0 ? field.depth.data : field.views[view].planes[0];
}

/* Returns the problem of the last call, or null if the last call reports none. */
EXPORT(problem) const starfocus_problem* Problem(void) { return refused; }

/* Prepares the light field, whose pixels JavaScript has written to the memory that Place returns.
 */
EXPORT(prepare) starfocus_status Prepare(void) {
  refused = starfocus_engine_problem(engine);
  return starfocus_prepare(engine, &field, prepared_memory, prepared_bytes, &prepared);
}

/* Starts call `number`: resets the parameters, the progress and the list of blocks. */
EXPORT(aim) void Aim(int32_t number) {
  call = number;
  shared.rows_done = shared.rows = rows_before = rows_after = 0;
  block_count = 0;
  starfocus_params_init(&params);
  starfocus_study_init(&study);
  params.study = &study;
  SetCallbacks(NULL);
}

/* Sets the field of starfocus_params or starfocus_study that `text` names. Returns 0 if there is no
 * such field. */
EXPORT(set) int Set(double value) {
  return SetField("starfocus_params", &params, text, value) ||
         SetField("starfocus_study", &study, text, value);
}

/* Makes the refocusings of the current call record their blocks. */
EXPORT(watch) void WatchBlocks(void) {
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  observer.on_block = KeepBlock;
  SetCallbacks(&observer);
}

/* Returns the number of pixels that represent the range [start, start + size) of the picture at
 * 1 / 2^shift of the size. */
static int32_t Reduced(int64_t start, int64_t size, int32_t shift) {
  return size < 1 ? 0 : (int32_t)(((start + size - 1) >> shift) - (start >> shift) + 1);
}

/* Refocuses with the current parameters at 1 / 2^shift of the size. Writes rows of R, G, B, A
 * without gaps to the memory that Picture returns. */
EXPORT(refocus) starfocus_status Refocus(int32_t shift) {
  const starfocus_region* const region = &params.region;
  const int whole = region->width == 0 && region->height == 0;
  refused = starfocus_engine_problem(engine);
  width = Reduced(whole ? 0 : region->x, whole ? config.width : region->width, shift & 31);
  height = Reduced(whole ? 0 : region->y, whole ? config.height : region->height, shift & 31);
  const starfocus_image out = {
      .format = STARFOCUS_FORMAT_RGBX, .planes = {picture}, .strides = {4 * (size_t)width}};
  params.preview_shift = shift;
  return starfocus_refocus_prepared(engine, &params, prepared, &out, NULL);
}

EXPORT(picture_width) int32_t PictureWidth(void) { return width; }
EXPORT(picture_height) int32_t PictureHeight(void) { return height; }
EXPORT(picture) const uint8_t* Picture(void) { return picture; }
EXPORT(blocks) const starfocus_block* Blocks(void) { return blocks; }
EXPORT(block_count) int32_t BlockCount(void) { return block_count; }
EXPORT(shared) void* Shared(void) { return &shared; }

/* Finds the focus for a pixel of the picture, and writes it to `text` as a double. */
EXPORT(focus_at) starfocus_status FocusAt(int32_t x, int32_t y) {
  double focus = 0;
  refused = &problem;
  const starfocus_status status =
      starfocus_focus_at(&field.depth, config.width, config.height, x, y, &focus, &problem);
  memcpy(text, &focus, sizeof(focus));
  return status;
}

EXPORT(status_string) const char* StatusString(starfocus_status status) {
  return starfocus_status_string(status);
}
EXPORT(version) const char* Version(void) { return starfocus_version(NULL); }

// SPDX-License-Identifier: Apache-2.0
// Native methods of dev.starfocus.Native.
#include <jni.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <new>

#include "platform/java/src/main/cpp/exceptions.h"
#include "platform/java/src/main/cpp/fields.h"
#include "platform/java/src/main/cpp/pictures.h"
#include "starfocus/pool.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// A session: an engine, its threads and its prepared light field. Refocuser.java ensures that only
// one call at a time uses a session, except for the atomic fields.
struct Session {
  starfocus_config config = {};
  starfocus_pool* pool = nullptr;
  starfocus_engine* engine = nullptr;
  void* prepared_memory = nullptr;
  starfocus_prepared* prepared = nullptr;
  MapCopy prepared_map;
  std::atomic<int> cancelled{0}, rows_done{0};
};

// Frees a session. The function End calls free() instead of `delete`, because libstarfocus_jni must
// not depend on the C++ run time.
void End(Session* session) {
  std::free(session->prepared_memory);
  starfocus_destroy(session->engine);
  starfocus_pool_destroy(session->pool);
  session->~Session();
  std::free(session);
}

Session* From(jlong handle) { return reinterpret_cast<Session*>(handle); }

// Progress callback. Stores the number of finished rows for rowsDone(). The callback must not call
// Java, because threads of the pool are not attached to the Java virtual machine.
int Tell(void* data, int32_t rows_done, int32_t) {
  auto* const session = static_cast<Session*>(data);
  session->rows_done.store(rows_done, std::memory_order_relaxed);
  return session->cancelled.load(std::memory_order_relaxed);
}

void Begin(Session* session) {
  session->cancelled.store(0, std::memory_order_relaxed);
  session->rows_done.store(0, std::memory_order_relaxed);
}

constexpr Field kConfigFields[] = {
    {"width", FieldType::kInt32, offsetof(starfocus_config, width)},
    {"height", FieldType::kInt32, offsetof(starfocus_config, height)},
    {"views", FieldType::kInt32, offsetof(starfocus_config, views)},
    {"disparityMin", FieldType::kDouble, offsetof(starfocus_config, disparity_min)},
    {"disparityMax", FieldType::kDouble, offsetof(starfocus_config, disparity_max)},
    {"maxBlur", FieldType::kDouble, offsetof(starfocus_config, max_blur)},
    {"workers", FieldType::kInt32, offsetof(starfocus_config, max_workers)},
    {"superblock", FieldType::kInt32, offsetof(starfocus_config, superblock)},
    {"nScale", FieldType::kDouble, offsetof(starfocus_config, tuning.n_scale)},
    {"transfer", FieldType::kInt32, offsetof(starfocus_config, transfer)},
    {"highlights", FieldType::kDouble, offsetof(starfocus_config, highlights)},
    {"previews", FieldType::kInt32, offsetof(starfocus_config, previews)},
};

constexpr Field kParamsFields[] = {
    {"mode", FieldType::kInt32, offsetof(starfocus_params, mode)},
    {"renderer", FieldType::kInt32, offsetof(starfocus_params, renderer)},
    {"focus", FieldType::kDouble, offsetof(starfocus_params, lens.focus)},
    {"focusNearer", FieldType::kDouble, offsetof(starfocus_params, lens.focus_nearer)},
    {"focusFarther", FieldType::kDouble, offsetof(starfocus_params, lens.focus_farther)},
    {"aperture", FieldType::kDouble, offsetof(starfocus_params, lens.aperture)},
    {"shape", FieldType::kInt32, offsetof(starfocus_params, lens.shape)},
    {"blades", FieldType::kInt32, offsetof(starfocus_params, lens.blades)},
    {"theta", FieldType::kDouble, offsetof(starfocus_params, lens.theta)},
    {"rotation", FieldType::kDouble, offsetof(starfocus_params, lens.rotation)},
    {"curvature", FieldType::kDouble, offsetof(starfocus_params, lens.curvature)},
    {"ringInner", FieldType::kDouble, offsetof(starfocus_params, lens.ring_inner)},
    {"catsEye", FieldType::kDouble, offsetof(starfocus_params, lens.cats_eye)},
    {"regionX", FieldType::kInt32, offsetof(starfocus_params, region.x)},
    {"regionY", FieldType::kInt32, offsetof(starfocus_params, region.y)},
    {"regionWidth", FieldType::kInt32, offsetof(starfocus_params, region.width)},
    {"regionHeight", FieldType::kInt32, offsetof(starfocus_params, region.height)},
};

// Reads Configuration.positions, unless this array is null. Returns false, with an exception
// pending, if the array has the wrong length.
bool ReadPositions(JNIEnv* env, jobject configuration, starfocus_config* config) {
  const auto positions =
      static_cast<jdoubleArray>(ReadObject(env, configuration, "positions", "[D"));
  if (positions == nullptr) return !env->ExceptionCheck();
  if (config->views < 1 || config->views > STARFOCUS_MAX_VIEWS)
    return true;  // starfocus_create rejects invalid numbers of views
  const jsize found = env->GetArrayLength(positions), expected = 2 * config->views;
  if (found != expected) {
    ThrowArgument(env, "positions: expected %d numbers, found %d", int{expected}, int{found});
    return false;
  }
  double places[2 * STARFOCUS_MAX_VIEWS];
  env->GetDoubleArrayRegion(positions, 0, expected, places);
  for (int k = 0; k < config->views; ++k) config->positions[k] = {places[2 * k], places[2 * k + 1]};
  return true;
}

// Returns the number of pixels at 1 / 2^shift of the size that overlap the pixels [first, first +
// count) of the full size. `count` must be at least 1.
int32_t Reduced(int32_t first, int32_t count, int32_t shift) {
  return static_cast<int32_t>(((int64_t{first} + count - 1) >> shift) - (first >> shift) + 1);
}

// Arguments of a call that refocuses a picture at 1 / 2^shift of the full size.
struct JavaTask {
  int32_t shift;
  jobject parameters, out;
};

// Converts the Java arguments of a refocus call to C structures. Returns false, with an exception
// pending, if the arguments are invalid.
bool ReadTask(JNIEnv* env, Session* session, const JavaTask& task, starfocus_params* params,
              starfocus_image* image) {
  const int32_t shift = task.shift;
  const jobject parameters = task.parameters, out = task.out;
  starfocus_params_init(params);
  if (!ReadFields(env, parameters, kParamsFields, std::size(kParamsFields), params)) return false;
  params->preview_shift = shift;
  const starfocus_region& region = params->region;
  const bool whole = region.width == 0 && region.height == 0;
  // The engine checks the region and the shift later. Replace invalid values of the region and the
  // shift by valid values, so that the size of the buffer can be checked.
  const int32_t width = whole ? session->config.width : region.width < 1 ? 1 : region.width;
  const int32_t height = whole ? session->config.height : region.height < 1 ? 1 : region.height;
  const int32_t known = shift < 0 || shift > STARFOCUS_MAX_PREVIEW ? 0 : shift;
  return ReadImage(env, out, "out", Reduced(region.x, width, known),
                   Reduced(region.y, height, known), image);
}

// Creates the pool and the engine of a session. The caller must have set the configuration of the
// session.
starfocus_status Start(Session* session) {
  starfocus_config* const config = &session->config;
  config->features |= STARFOCUS_FEATURE_IMAGES;
  if (config->max_workers != 1) {
    session->pool = starfocus_pool_create(config->max_workers);
    if (session->pool == nullptr) return STARFOCUS_ERROR_MEMORY;
    config->max_workers = starfocus_pool_workers(session->pool);
  }
  const starfocus_status status = starfocus_create(config, nullptr, &session->engine);
  if (status != STARFOCUS_OK) return status;
  starfocus_callbacks callbacks = {};
  callbacks.runner = session->pool != nullptr ? starfocus_pool_run : nullptr;
  callbacks.runner_data = session->pool;
  callbacks.progress = Tell;
  callbacks.progress_data = session;
  return starfocus_set_callbacks(session->engine, &callbacks);
}

// Argument of a function of the C library that reports no starfocus_problem, and its range.
struct PlaceValue {
  const char* name;
  int32_t value, low, high;
};

// Returns false, with an exception pending that names the argument, if the value is out of range.
bool CheckRange(JNIEnv* env, const PlaceValue& from) {
  if (from.value >= from.low && from.value <= from.high) return true;
  char expected[40];
  std::snprintf(expected, sizeof expected, "%d to %d", from.low, from.high);
  const starfocus_problem problem = {
      STARFOCUS_ERROR_RANGE, 0,  from.name, expected, double(from.value), double(from.low),
      double(from.high),     -1, -1};
  ThrowStatus(env, STARFOCUS_ERROR_RANGE, &problem);
  return false;
}

// Returns an array of two numbers, or null if an exception is pending.
jdoubleArray NewPair(JNIEnv* env, double first, double second) {
  if (env->ExceptionCheck()) return nullptr;
  const double pair[2] = {first, second};
  const jdoubleArray array = env->NewDoubleArray(2);
  if (array != nullptr) env->SetDoubleArrayRegion(array, 0, 2, pair);
  return array;
}

// Prepares a light field. The first call of a session allocates the memory for prepared light
// fields.
starfocus_status Prepare(Session* session, const starfocus_light_field& field) {
  size_t bytes = 0;
  const starfocus_status status = starfocus_prepared_size(&session->config, &bytes);
  if (status != STARFOCUS_OK) return status;
  if (session->prepared_memory == nullptr &&
      posix_memalign(&session->prepared_memory, STARFOCUS_ALIGNMENT, bytes) != 0) {
    return STARFOCUS_ERROR_MEMORY;
  }
  Begin(session);
  return starfocus_prepare(session->engine, &field, session->prepared_memory, bytes,
                           &session->prepared);
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

#define STARFOCUS_NATIVE(type, name) \
  extern "C" JNIEXPORT type JNICALL Java_dev_starfocus_Native_##name

STARFOCUS_NATIVE(void, initialize__Ldev_starfocus_Configuration_2)
(JNIEnv* env, jclass, jobject object) {
  starfocus_config config;
  starfocus_config_init(&config);
  config.max_workers = 0;
  WriteFields(env, &config, kConfigFields, std::size(kConfigFields), object);
}

STARFOCUS_NATIVE(void, initialize__Ldev_starfocus_Parameters_2)
(JNIEnv* env, jclass, jobject object) {
  starfocus_params params;
  starfocus_params_init(&params);
  WriteFields(env, &params, kParamsFields, std::size(kParamsFields), object);
}

STARFOCUS_NATIVE(jlong, create)(JNIEnv* env, jclass, jobject configuration) {
  void* const memory = std::malloc(sizeof(Session));
  if (memory == nullptr) {
    ThrowStatus(env, STARFOCUS_ERROR_MEMORY);
    return 0;
  }
  auto* const session = new (memory) Session;
  starfocus_config_init(&session->config);
  if (ReadFields(env, configuration, kConfigFields, std::size(kConfigFields), &session->config) &&
      ReadPositions(env, configuration, &session->config)) {
    if (ReadInt(env, configuration, "fillUnknown") != 0) {
      session->config.features |= STARFOCUS_FEATURE_FILL_UNKNOWN;
    }
    if (ReadInt(env, configuration, "shapes") != 0) {
      session->config.features |= STARFOCUS_FEATURE_SHAPES;
    }
    starfocus_problem problem = {};
    session->config.problem = &problem;
    const starfocus_status status = Start(session);
    session->config.problem = nullptr;
    if (status == STARFOCUS_OK) return reinterpret_cast<jlong>(session);
    ThrowStatus(env, status, &problem);
  }
  End(session);
  return 0;
}

STARFOCUS_NATIVE(void, destroy)(JNIEnv*, jclass, jlong handle) { End(From(handle)); }

STARFOCUS_NATIVE(void, refocus)
(JNIEnv* env, jclass, jlong handle, jobject light_field, jobject parameters, jobject out) {
  Session* const session = From(handle);
  starfocus_light_field field;
  MapCopy copy;
  starfocus_params params;
  starfocus_image image;
  if (!ReadLightField(env, light_field, session->config, &field, &copy) ||
      !ReadTask(env, session, {0, parameters, out}, &params, &image)) {
    return;
  }
  Begin(session);
  ThrowStatus(env, starfocus_refocus(session->engine, &params, &field, &image, nullptr),
              starfocus_engine_problem(session->engine));
}

STARFOCUS_NATIVE(void, prepare)
(JNIEnv* env, jclass, jlong handle, jobject light_field) {
  Session* const session = From(handle);
  starfocus_light_field field;
  session->prepared = nullptr;
  if (ReadLightField(env, light_field, session->config, &field, &session->prepared_map)) {
    ThrowStatus(env, Prepare(session, field), starfocus_engine_problem(session->engine));
  }
}

STARFOCUS_NATIVE(void, refocusPrepared)
(JNIEnv* env, jclass, jlong handle, jobject parameters, jobject out) {
  Session* const session = From(handle);
  starfocus_params params;
  starfocus_image image;
  if (!ReadTask(env, session, {0, parameters, out}, &params, &image)) return;
  Begin(session);
  ThrowStatus(
      env, starfocus_refocus_prepared(session->engine, &params, session->prepared, &image, nullptr),
      starfocus_engine_problem(session->engine));
}

STARFOCUS_NATIVE(void, preview)
(JNIEnv* env, jclass, jlong handle, jint shift, jobject parameters, jobject out) {
  Session* const session = From(handle);
  starfocus_params params;
  starfocus_image image;
  if (!ReadTask(env, session, {shift, parameters, out}, &params, &image)) return;
  Begin(session);
  ThrowStatus(
      env, starfocus_refocus_prepared(session->engine, &params, session->prepared, &image, nullptr),
      starfocus_engine_problem(session->engine));
}

STARFOCUS_NATIVE(void, cancel)(JNIEnv*, jclass, jlong handle) {
  From(handle)->cancelled.store(1, std::memory_order_relaxed);
}

STARFOCUS_NATIVE(jint, rowsDone)(JNIEnv*, jclass, jlong handle) {
  return From(handle)->rows_done.load(std::memory_order_relaxed);
}

STARFOCUS_NATIVE(jdouble, focusAt)
(JNIEnv* env, jclass, jobject depth, jintArray place) {
  jint at[4] = {};  // width, height, x, y
  env->GetIntArrayRegion(place, 0, 4, at);
  starfocus_depth_map map;
  MapCopy copy;
  double focus = 0;
  if (!ReadDepthMap(env, depth, &map, &copy)) return focus;
  const PlaceValue values[] = {{"width", at[0], map.width, STARFOCUS_MAX_SIZE},
                               {"height", at[1], map.height, STARFOCUS_MAX_SIZE},
                               {"x", at[2], 0, at[0] - 1},
                               {"y", at[3], 0, at[1] - 1}};
  for (const PlaceValue& value : values) {
    if (!CheckRange(env, value)) return focus;
  }
  ThrowStatus(env, starfocus_focus_at(&map, at[0], at[1], at[2], at[3], &focus));
  return focus;
}

STARFOCUS_NATIVE(jdouble, largestAperture)
(JNIEnv* env, jclass, jlong handle, jobject parameters) {
  starfocus_engine* const engine = From(handle)->engine;
  starfocus_params params;
  starfocus_params_init(&params);
  double aperture = 0;
  if (ReadFields(env, parameters, kParamsFields, std::size(kParamsFields), &params)) {
    ThrowStatus(env, starfocus_largest_aperture(engine, &params.lens, &aperture),
                starfocus_engine_problem(engine));
  }
  return aperture;
}

STARFOCUS_NATIVE(jdoubleArray, measureDisparity)(JNIEnv* env, jclass, jobject depth) {
  starfocus_depth_map map;
  MapCopy copy;
  starfocus_disparity_stats stats = {};
  if (!ReadDepthMap(env, depth, &map, &copy)) return nullptr;
  ThrowStatus(env, starfocus_measure_disparity(&map, &stats));
  return NewPair(env, stats.min, stats.max);
}

STARFOCUS_NATIVE(jdoubleArray, viewPosition)(JNIEnv* env, jclass, jint index) {
  double u = 0, v = 0;
  if (!starfocus_view_position(index, &u, &v)) ThrowStatus(env, STARFOCUS_ERROR_RANGE);
  return NewPair(env, u, v);
}

STARFOCUS_NATIVE(jstring, version)(JNIEnv* env, jclass) {
  char text[100];
  std::snprintf(text, sizeof text, "%s, %s", starfocus_version(), starfocus_simd_target());
  return env->NewStringUTF(text);
}

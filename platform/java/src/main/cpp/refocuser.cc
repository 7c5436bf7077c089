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
#include "starfocus/starfocus.hpp"

namespace starfocus {
namespace {

// A session: an engine, its threads and its prepared light field. Refocuser.java ensures that only
// one call at a time uses a session, except for the atomic fields.
struct Session {
  Config config;
  starfocus_pool* pool = nullptr;
  starfocus_engine* engine = nullptr;
  starfocus_prepared* prepared = nullptr;
  MapCopy prepared_map;
  std::atomic<int> cancelled{0}, rows_done{0};
};

// Frees a session. The function End calls free() instead of `delete`, because libstarfocus_jni must
// not depend on the C++ run time.
void End(Session* session) {
  starfocus_destroy_prepared(session->prepared);
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

// Fields of Configuration and Parameters, by the C structure that they belong to.
constexpr const char* kConfigNames[] = {"width",        "height",  "views",      "disparityMin",
                                        "disparityMax", "maxBlur", "superblock", "transfer",
                                        "highlights",   "previews"};
constexpr Fields kConfig = {"starfocus_config", kConfigNames, std::size(kConfigNames)};
constexpr const char* kTuningNames[] = {"nScale"};
constexpr Fields kTuning = {"starfocus_tuning", kTuningNames, std::size(kTuningNames)};
constexpr const char* kParamsNames[] = {"focus",     "focusNearer", "focusFarther", "aperture",
                                        "shape",     "blades",      "theta",        "rotation",
                                        "curvature", "ringInner",   "catsEye",      "regionX",
                                        "regionY",   "regionWidth", "regionHeight"};
constexpr Fields kParams = {"starfocus_params", kParamsNames, std::size(kParamsNames)};
constexpr const char* kStudyNames[] = {"mode", "renderer"};
constexpr Fields kStudy = {"starfocus_study", kStudyNames, std::size(kStudyNames)};

// Reads a Configuration, except for its positions.
bool ReadConfig(JNIEnv* env, jobject configuration, Config* config) {
  if (!ReadFields(env, configuration, kConfig, config) ||
      !ReadFields(env, configuration, kTuning, &config->tuning)) {
    return false;
  }
  config->tuning.line_scan = starfocus_line_scan_renderer();
  config->max_workers = ReadInt(env, configuration, "workers");
  if (ReadInt(env, configuration, "fillUnknown") != 0) config->unknown = STARFOCUS_UNKNOWN_FILL;
  if (ReadInt(env, configuration, "shapes") != 0) config->features |= STARFOCUS_FEATURE_SHAPES;
  return true;
}

bool ReadParams(JNIEnv* env, jobject parameters, Params* params) {
  return ReadFields(env, parameters, kParams, params) &&
         ReadFields(env, parameters, kStudy, &params->study);
}

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
bool ReadTask(JNIEnv* env, Session* session, const JavaTask& task, Params* params,
              starfocus_image* image) {
  const int32_t shift = task.shift;
  const jobject parameters = task.parameters, out = task.out;
  if (!ReadParams(env, parameters, params)) return false;
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
starfocus_status Start(Session* session, starfocus_problem* problem) {
  Config* const config = &session->config;
  config->features |= STARFOCUS_FEATURE_IMAGES;
  if (config->max_workers != 1) {
    session->pool = starfocus_pool_create(config->max_workers);
    if (session->pool == nullptr) return STARFOCUS_ERROR_MEMORY;
    config->max_workers = starfocus_pool_workers(session->pool);
  }
  const starfocus_status status = starfocus_create(config, nullptr, &session->engine, problem);
  if (status != STARFOCUS_OK) return status;
  starfocus_callbacks callbacks = {};
  callbacks.runner = session->pool != nullptr ? starfocus_pool_run : nullptr;
  callbacks.runner_data = session->pool;
  callbacks.progress = Tell;
  callbacks.progress_data = session;
  return starfocus_set_callbacks(session->engine, &callbacks);
}

// Returns an array of two numbers, or null if an exception is pending.
jdoubleArray NewPair(JNIEnv* env, double first, double second) {
  if (env->ExceptionCheck()) return nullptr;
  const double pair[2] = {first, second};
  const jdoubleArray array = env->NewDoubleArray(2);
  if (array != nullptr) env->SetDoubleArrayRegion(array, 0, 2, pair);
  return array;
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

#define STARFOCUS_NATIVE(type, name) \
  extern "C" JNIEXPORT type JNICALL Java_dev_starfocus_Native_##name

STARFOCUS_NATIVE(void, initialize__Ldev_starfocus_Configuration_2)
(JNIEnv* env, jclass, jobject object) {
  const Config config;
  if (WriteFields(env, &config, kConfig, object)) WriteFields(env, &config.tuning, kTuning, object);
}

STARFOCUS_NATIVE(void, initialize__Ldev_starfocus_Parameters_2)
(JNIEnv* env, jclass, jobject object) {
  const Params params;
  if (WriteFields(env, &params, kParams, object)) WriteFields(env, &params.study, kStudy, object);
}

STARFOCUS_NATIVE(jlong, create)(JNIEnv* env, jclass, jobject configuration) {
  void* const memory = std::malloc(sizeof(Session));
  if (memory == nullptr) {
    ThrowStatus(env, STARFOCUS_ERROR_MEMORY);
    return 0;
  }
  auto* const session = new (memory) Session;
  if (ReadConfig(env, configuration, &session->config) &&
      ReadPositions(env, configuration, &session->config)) {
    starfocus_problem problem = {};
    const starfocus_status status = Start(session, &problem);
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
  starfocus_light_field field = NewLightField();
  MapCopy copy;
  Params params;
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
  starfocus_light_field field = NewLightField();
  starfocus_destroy_prepared(session->prepared);
  session->prepared = nullptr;
  if (!ReadLightField(env, light_field, session->config, &field, &session->prepared_map)) return;
  Begin(session);
  ThrowStatus(env, starfocus_prepare(session->engine, &field, nullptr, 0, &session->prepared),
              starfocus_engine_problem(session->engine));
}

STARFOCUS_NATIVE(void, refocusPrepared)
(JNIEnv* env, jclass, jlong handle, jint shift, jobject parameters, jobject out) {
  Session* const session = From(handle);
  Params params;
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
  starfocus_problem problem = {};
  ThrowStatus(env, starfocus_focus_at(&map, at[0], at[1], at[2], at[3], &focus, &problem),
              &problem);
  return focus;
}

STARFOCUS_NATIVE(jdouble, largestAperture)
(JNIEnv* env, jclass, jlong handle, jobject parameters) {
  starfocus_engine* const engine = From(handle)->engine;
  Params params;
  double aperture = 0;
  if (ReadParams(env, parameters, &params)) {
    ThrowStatus(env, starfocus_largest_aperture(engine, &params, &aperture),
                starfocus_engine_problem(engine));
  }
  return aperture;
}

STARFOCUS_NATIVE(jdoubleArray, measureDisparity)(JNIEnv* env, jclass, jobject depth) {
  starfocus_depth_map map;
  MapCopy copy;
  starfocus_disparity_stats stats = {};
  if (!ReadDepthMap(env, depth, &map, &copy)) return nullptr;
  starfocus_problem problem = {};
  ThrowStatus(env, starfocus_measure_disparity(&map, &stats, &problem), &problem);
  return NewPair(env, stats.min, stats.max);
}

STARFOCUS_NATIVE(jdoubleArray, viewPosition)(JNIEnv* env, jclass, jint index) {
  double u = 0, v = 0;
  starfocus_problem problem = {};
  ThrowStatus(env, starfocus_view_position(index, &u, &v, &problem), &problem);
  return NewPair(env, u, v);
}

STARFOCUS_NATIVE(jstring, version)(JNIEnv* env, jclass) {
  char text[100];
  std::snprintf(text, sizeof text, "%s, %s", starfocus_version(nullptr), starfocus_simd_target());
  return env->NewStringUTF(text);
}

// SPDX-License-Identifier: Apache-2.0
#include "platform/java/src/main/cpp/pictures.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "platform/java/src/main/cpp/exceptions.h"
#include "platform/java/src/main/cpp/fields.h"

namespace starfocus {
namespace {

struct PlaneSize {
  int64_t rows, row_bytes;
};

// Finds the size of a plane, which has 0 rows if the format lacks the plane. Returns false, with an
// exception pending, if the library rejects the format or the pixel_stride.
bool FindSize(JNIEnv* env, const starfocus_image& image, int plane, int32_t width, int32_t height,
              PlaneSize* size) {
  int32_t rows = 0;
  size_t row_bytes = 0;
  starfocus_problem problem = {};
  const starfocus_status status =
      starfocus_plane_size(&image, plane, width, height, &rows, &row_bytes, &problem);
  ThrowStatus(env, status, &problem);
  *size = {rows, static_cast<int64_t>(row_bytes)};
  return status == STARFOCUS_OK;
}

// Returns the address of a direct buffer. Returns null, with an exception pending, if the buffer is
// too small for rows that are `stride` bytes apart.
void* AddressOf(JNIEnv* env, jobject buffer, const char* what, PlaneSize size, int64_t stride) {
  void* const address = buffer == nullptr ? nullptr : env->GetDirectBufferAddress(buffer);
  if (address == nullptr) {
    ThrowArgument(env, "%s: expected a direct buffer", what);
    return nullptr;
  }
  if (stride < 0) {
    ThrowArgument(env, "%s: expected a stride of 0 or more, found %lld", what,
                  static_cast<long long>(stride));
    return nullptr;
  }
  const int64_t needed = stride * (size.rows - 1) + size.row_bytes;
  const int64_t capacity = env->GetDirectBufferCapacity(buffer);
  if (capacity < needed) {
    ThrowArgument(env, "%s: expected a buffer of %lld bytes at least, found %lld", what,
                  static_cast<long long>(needed), static_cast<long long>(capacity));
    return nullptr;
  }
  return address;
}

// A Java object of class Image, the name of the image in error messages, and the planes of the
// image.
struct NamedImage {
  jobject object;
  const char* what;
  jobjectArray planes;
};

bool ReadPlane(JNIEnv* env, const NamedImage& from, int plane, PlaneSize size,
               starfocus_image* image) {
  const auto strides = static_cast<jintArray>(ReadObject(env, from.object, "strides", "[I"));
  if (strides == nullptr) return false;
  jint stride = 0;
  env->GetIntArrayRegion(strides, plane, 1, &stride);
  const jobject buffer = env->GetObjectArrayElement(from.planes, plane);
  char name[60];
  std::snprintf(name, sizeof name, "%s, plane %d", from.what, plane);
  void* const address = AddressOf(env, buffer, name, size, stride);
  image->planes[plane] = address;
  image->strides[plane] = static_cast<size_t>(stride);
  env->DeleteLocalRef(buffer);
  env->DeleteLocalRef(strides);
  return address != nullptr;
}

constexpr const char* kImageNames[] = {"format", "matrix", "range", "pixelStride"};
constexpr Fields kImage = {"starfocus_image", kImageNames, std::size(kImageNames)};
constexpr const char* kDepthNames[] = {"width", "height", "type",       "meaning",
                                       "scale", "offset", "hasInvalid", "invalid"};
constexpr Fields kDepth = {"starfocus_depth_map", kDepthNames, std::size(kDepthNames)};

int64_t BytesOf(int32_t type) {
  if (type == STARFOCUS_DEPTH_FLOAT) return 4;
  return type == STARFOCUS_DEPTH_U8 ? 1 : 2;
}

// Copies the rows of a map to packed memory, unless the rows are aligned and follow each other from
// top to bottom. `stride` is negative if the map starts with its bottom row.
bool MakeReadable(JNIEnv* env, int64_t stride, starfocus_depth_map* map, MapCopy* copy) {
  const int64_t bytes = BytesOf(map->type), row = bytes * map->width, step = std::abs(stride);
  const bool aligned = (reinterpret_cast<uintptr_t>(map->data) | static_cast<uintptr_t>(step)) %
                           static_cast<uintptr_t>(bytes) ==
                       0;
  map->stride = static_cast<size_t>(step);
  if (stride >= 0 && aligned) return true;
  if (step < row) {
    ThrowArgument(env, "depth: expected a stride of %lld bytes at least, found %lld",
                  static_cast<long long>(row), static_cast<long long>(stride));
    return false;
  }
  std::free(copy->rows);
  copy->rows = std::malloc(static_cast<size_t>(row * map->height));
  if (copy->rows == nullptr) {
    ThrowStatus(env, STARFOCUS_ERROR_MEMORY);
    return false;
  }
  for (int32_t y = 0; y < map->height; ++y) {
    const int64_t from = stride < 0 ? map->height - 1 - y : y;
    std::memcpy(static_cast<char*>(copy->rows) + row * y,
                static_cast<const char*>(map->data) + step * from, static_cast<size_t>(row));
  }
  map->data = copy->rows;
  map->stride = static_cast<size_t>(row);
  return true;
}

// Reads the coverage of a LightField, unless the coverage is null.
bool ReadCoverage(JNIEnv* env, jobject light_field, const starfocus_config& config,
                  starfocus_light_field* field) {
  const jobject buffer = ReadObject(env, light_field, "coverage", "Ljava/nio/ByteBuffer;");
  const int32_t stride = ReadInt(env, light_field, "coverageStride");
  if (buffer == nullptr || env->ExceptionCheck()) return !env->ExceptionCheck();
  const PlaneSize size = {config.height, config.width};
  field->coverage = static_cast<const uint8_t*>(AddressOf(env, buffer, "coverage", size, stride));
  field->coverage_stride = static_cast<size_t>(stride);
  return field->coverage != nullptr;
}

}  // namespace

bool ReadImage(JNIEnv* env, jobject object, const char* what, int32_t width, int32_t height,
               starfocus_image* image) {
  *image = {};
  if (object == nullptr) {
    ThrowArgument(env, "%s: expected an image, found null", what);
    return false;
  }
  if (!ReadFields(env, object, kImage, image)) return false;
  const auto planes =
      static_cast<jobjectArray>(ReadObject(env, object, "planes", "[Ljava/nio/ByteBuffer;"));
  if (planes == nullptr) return false;
  constexpr int kMost = sizeof image->planes / sizeof *image->planes;
  PlaneSize sizes[kMost];
  int expected = 0;
  for (int i = 0; i < kMost; ++i) {
    if (!FindSize(env, *image, i, width, height, &sizes[i])) return false;
    if (sizes[i].rows > 0) ++expected;
  }
  const int found = env->GetArrayLength(planes);
  if (found != expected) {
    ThrowArgument(env, "%s: expected %d planes, found %d", what, expected, found);
    return false;
  }
  for (int i = 0; i < expected; ++i) {
    if (!ReadPlane(env, {object, what, planes}, i, sizes[i], image)) return false;
  }
  env->DeleteLocalRef(planes);
  return true;
}

bool ReadDepthMap(JNIEnv* env, jobject object, starfocus_depth_map* map, MapCopy* copy) {
  *map = {};
  if (object == nullptr) {
    ThrowArgument(env, "depth: expected a depth map, found null");
    return false;
  }
  if (!ReadFields(env, object, kDepth, map)) return false;
  if (map->width < 1 || map->height < 1) {
    ThrowArgument(env, "depth: expected a width and a height of 1 or more, found %d and %d",
                  map->width, map->height);
    return false;
  }
  const int64_t stride = ReadInt(env, object, "stride");
  const jobject values = ReadObject(env, object, "values", "Ljava/nio/ByteBuffer;");
  if (env->ExceptionCheck()) return false;
  const PlaneSize size = {map->height, BytesOf(map->type) * map->width};
  map->data = AddressOf(env, values, "depth", size, std::abs(stride));
  return map->data != nullptr && MakeReadable(env, stride, map, copy);
}

bool ReadLightField(JNIEnv* env, jobject light_field, const starfocus_config& config,
                    starfocus_light_field* field, MapCopy* copy) {
  const auto views =
      static_cast<jobjectArray>(ReadObject(env, light_field, "views", "[Ldev/starfocus/Image;"));
  if (views == nullptr) return false;
  const jobject depth = ReadObject(env, light_field, "depth", "Ldev/starfocus/DepthMap;");
  if (env->ExceptionCheck()) return false;
  const int32_t count = config.views, found = env->GetArrayLength(views);
  if (found != count) {
    ThrowArgument(env, "views: expected %d, found %d", count, found);
    return false;
  }
  for (int32_t i = 0; i < count; ++i) {
    const jobject view = env->GetObjectArrayElement(views, i);
    char what[20];
    std::snprintf(what, sizeof what, "view %d", i);
    if (!ReadImage(env, view, what, config.width, config.height, &field->views[i])) return false;
    env->DeleteLocalRef(view);
  }
  return ReadDepthMap(env, depth, &field->depth, copy) &&
         ReadCoverage(env, light_field, config, field);
}

}  // namespace starfocus

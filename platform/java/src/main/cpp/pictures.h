// SPDX-License-Identifier: Apache-2.0
// Converts Java images, depth maps and light fields to C structures that point into the direct
// buffers of the Java objects. The functions of this header check that every direct buffer is as
// large as its description requires. Used by refocuser.cc.
#ifndef STARFOCUS_PLATFORM_JAVA_PICTURES_H_
#define STARFOCUS_PLATFORM_JAVA_PICTURES_H_

#include <jni.h>

#include <cstdlib>

#include "starfocus/starfocus.h"

namespace starfocus {

// Each function of this header returns false, with an exception pending, if an object is null, a
// buffer is not direct, or a buffer is too small. The C library checks all other values, such as
// formats and strides of images.

// Owns the copy of a depth map that the C library cannot read in place.
struct MapCopy {
  MapCopy() = default;
  MapCopy(const MapCopy&) = delete;
  MapCopy& operator=(const MapCopy&) = delete;
  ~MapCopy() { std::free(rows); }

  void* rows = nullptr;
};

// Converts an Image with a size of `width` x `height` pixels. `what` is the name of the image in
// error messages.
bool ReadImage(JNIEnv* env, jobject object, const char* what, int32_t width, int32_t height,
               starfocus_image* image);

// Converts a DepthMap. If its rows are not aligned or are stored from bottom to top, they are
// copied to `copy`, which must exist as long as the map is used.
bool ReadDepthMap(JNIEnv* env, jobject object, starfocus_depth_map* map, MapCopy* copy);

// Converts a LightField with the number and size of views of the configuration.
bool ReadLightField(JNIEnv* env, jobject light_field, const starfocus_config& config,
                    starfocus_light_field* field, MapCopy* copy);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_PICTURES_H_

// SPDX-License-Identifier: Apache-2.0
// Converts Java images, depth maps and light fields to C structures that point into the direct
// buffers of the Java objects. The functions of this header check that every direct buffer is as
// large as its description requires. Used by refocuser.cc.
#ifndef STARFOCUS_PLATFORM_JAVA_PICTURES_H_
#define STARFOCUS_PLATFORM_JAVA_PICTURES_H_

#include <jni.h>

#include "starfocus/starfocus.h"

namespace starfocus {

// Each function of this header returns false, with an exception pending, if an object is null, a
// buffer is not direct, or a buffer is too small. The C library checks all other values, such as
// formats and strides.

// Converts an Image with a size of `width` x `height` pixels. `what` is the name of the image in
// error messages.
bool ReadImage(JNIEnv* env, jobject object, const char* what, int32_t width, int32_t height,
               starfocus_image* image);

// Converts a DepthMap.
bool ReadDepthMap(JNIEnv* env, jobject object, starfocus_depth_map* map);

// Converts a LightField with the number and size of views of the configuration.
bool ReadLightField(JNIEnv* env, jobject light_field, const starfocus_config& config,
                    starfocus_light_field* field);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_PICTURES_H_

// SPDX-License-Identifier: Apache-2.0
// Java's images and depth maps as the library's: direct buffers, looked at where they are, each as
// long as what is said to be in it.
#ifndef STARFOCUS_PLATFORM_JAVA_PICTURES_H_
#define STARFOCUS_PLATFORM_JAVA_PICTURES_H_

#include <jni.h>

#include "starfocus/starfocus.h"

namespace starfocus {

// Each is false with an exception pending when an object is null or a buffer is not direct or too
// small. What the library checks itself, such as formats and strides, is left to it.

// An Image that is read, or written, of this size in pixels.
bool ReadImage(JNIEnv* env, jobject object, const char* what, int32_t width, int32_t height,
               starfocus_image* image);

// A DepthMap.
bool ReadDepthMap(JNIEnv* env, jobject object, starfocus_depth_map* map);

// A LightField with the views of the configuration.
bool ReadLightField(JNIEnv* env, jobject light_field, const starfocus_config& config,
                    starfocus_light_field* field);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_JAVA_PICTURES_H_

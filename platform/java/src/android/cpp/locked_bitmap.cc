// SPDX-License-Identifier: Apache-2.0
// Native methods of dev.starfocus.android.LockedBitmap.
#include <android/bitmap.h>
#include <jni.h>

#include "platform/java/src/main/cpp/exceptions.h"

using namespace starfocus;

extern "C" JNIEXPORT jobject JNICALL Java_dev_starfocus_android_LockedBitmap_lock(
    JNIEnv* env, jclass, jobject bitmap, jintArray stride) {
  AndroidBitmapInfo info = {};
  if (bitmap == nullptr || AndroidBitmap_getInfo(env, bitmap, &info) < 0 ||
      info.format != ANDROID_BITMAP_FORMAT_RGBA_8888) {
    ThrowArgument(env,
                  "LockedBitmap: expected a bitmap of the format ARGB_8888, found the format %d",
                  static_cast<int>(info.format));
    return nullptr;
  }
  void* pixels = nullptr;
  if (AndroidBitmap_lockPixels(env, bitmap, &pixels) < 0 || pixels == nullptr) {
    ThrowArgument(env, "LockedBitmap: expected a bitmap whose pixels can be locked");
    return nullptr;
  }
  const jint bytes = static_cast<jint>(info.stride);
  env->SetIntArrayRegion(stride, 0, 1, &bytes);
  const jobject buffer = env->NewDirectByteBuffer(pixels, jlong(info.stride) * jlong(info.height));
  if (buffer == nullptr) AndroidBitmap_unlockPixels(env, bitmap);
  return buffer;
}

extern "C" JNIEXPORT void JNICALL Java_dev_starfocus_android_LockedBitmap_unlock(JNIEnv* env,
                                                                                 jclass,
                                                                                 jobject bitmap) {
  AndroidBitmap_unlockPixels(env, bitmap);
}

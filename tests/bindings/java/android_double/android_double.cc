// SPDX-License-Identifier: Apache-2.0
// Replaces the NDK's functions for bitmaps and hardware buffers by functions that use the Java
// classes in this folder. Only one hardware buffer can be locked at a time.
#include <android/bitmap.h>
#include <android/hardware_buffer.h>
#include <android/hardware_buffer_jni.h>

namespace {

JNIEnv* current = nullptr;
jobject locked = nullptr;

int Get(JNIEnv* env, jobject object, const char* name) {
  return env->GetIntField(object, env->GetFieldID(env->GetObjectClass(object), name, "I"));
}

void AddLock(JNIEnv* env, jobject object, int change) {
  const jfieldID id = env->GetFieldID(env->GetObjectClass(object), "locks", "I");
  env->SetIntField(object, id, env->GetIntField(object, id) + change);
}

char* Memory(JNIEnv* env, jobject object, const char* name) {
  const jfieldID id = env->GetFieldID(env->GetObjectClass(object), name, "Ljava/nio/ByteBuffer;");
  return static_cast<char*>(env->GetDirectBufferAddress(env->GetObjectField(object, id)));
}

}  // namespace

extern "C" {

int AndroidBitmap_getInfo(JNIEnv* env, jobject bitmap, AndroidBitmapInfo* info) {
  info->width = static_cast<uint32_t>(Get(env, bitmap, "width"));
  info->height = static_cast<uint32_t>(Get(env, bitmap, "height"));
  info->stride = static_cast<uint32_t>(Get(env, bitmap, "stride"));
  info->format = Get(env, bitmap, "format");
  return ANDROID_BITMAP_RESULT_SUCCESS;
}

int AndroidBitmap_lockPixels(JNIEnv* env, jobject bitmap, void** address) {
  AddLock(env, bitmap, 1);
  *address = Memory(env, bitmap, "pixels");
  return ANDROID_BITMAP_RESULT_SUCCESS;
}

int AndroidBitmap_unlockPixels(JNIEnv* env, jobject bitmap) {
  AddLock(env, bitmap, -1);
  return ANDROID_BITMAP_RESULT_SUCCESS;
}

AHardwareBuffer* AHardwareBuffer_fromHardwareBuffer(JNIEnv* env, jobject object) {
  current = env;
  locked = object;
  return reinterpret_cast<AHardwareBuffer*>(object);
}

void AHardwareBuffer_describe(const AHardwareBuffer*, AHardwareBuffer_Desc* desc) {
  *desc = {};
  desc->width = static_cast<uint32_t>(Get(current, locked, "width"));
  desc->height = static_cast<uint32_t>(Get(current, locked, "height"));
  desc->layers = 1;
  desc->format = static_cast<uint32_t>(Get(current, locked, "format"));
}

int AHardwareBuffer_lockPlanes(AHardwareBuffer*, uint64_t, int32_t, const ARect*,
                               AHardwareBuffer_Planes* planes) {
  AddLock(current, locked, 1);
  char* const memory = Memory(current, locked, "memory");
  const auto row = static_cast<uint32_t>(Get(current, locked, "rowStride"));
  const auto pixel = static_cast<uint32_t>(Get(current, locked, "pixelStride"));
  const bool is_yuv = Get(current, locked, "format") == AHARDWAREBUFFER_FORMAT_Y8Cb8Cr8_420;
  char* const chroma = memory + row * static_cast<uint32_t>(Get(current, locked, "height"));
  *planes = {
      is_yuv ? 3u : 1u,
      {{memory, is_yuv ? 1 : pixel, row}, {chroma, pixel, row}, {chroma + 1, pixel, row}, {}}};
  return 0;
}

int AHardwareBuffer_unlock(AHardwareBuffer*, int32_t*) {
  AddLock(current, locked, -1);
  return 0;
}

}  // extern "C"

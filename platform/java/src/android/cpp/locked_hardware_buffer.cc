// SPDX-License-Identifier: Apache-2.0
// Native methods of dev.starfocus.android.LockedHardwareBuffer. The methods require Android API
// level 29.
#include <android/hardware_buffer.h>
#include <android/hardware_buffer_jni.h>
#include <jni.h>

#include "platform/java/src/main/cpp/exceptions.h"
#include "starfocus/starfocus.h"

using namespace starfocus;

namespace {

// The starfocus_format of a hardware buffer, and the bytes per pixel of the first plane.
// pixel_bytes is 0 for formats that the library does not support.
struct Kind {
  jint format, pixel_bytes;
};

Kind KindOf(uint32_t format) {
  switch (format) {
    case AHARDWAREBUFFER_FORMAT_R8G8B8A8_UNORM:
    case AHARDWAREBUFFER_FORMAT_R8G8B8X8_UNORM:
      return {STARFOCUS_FORMAT_RGBX, 4};
    case AHARDWAREBUFFER_FORMAT_R8G8B8_UNORM:
      return {STARFOCUS_FORMAT_RGB, 3};
    case AHARDWAREBUFFER_FORMAT_Y8Cb8Cr8_420:
      return {STARFOCUS_FORMAT_YUV_420_888, 1};
    default:
      return {0, 0};
  }
}

// Returns a direct ByteBuffer for a plane. The ByteBuffer ends with the last byte of the last
// pixel.
jobject BufferOf(JNIEnv* env, const AHardwareBuffer_Plane& plane, jlong width, jlong height,
                 jlong pixel_bytes) {
  const jlong row = (width - 1) * jlong(plane.pixelStride) + pixel_bytes;
  return env->NewDirectByteBuffer(plane.data, (height - 1) * jlong(plane.rowStride) + row);
}

}  // namespace

extern "C" JNIEXPORT jint JNICALL Java_dev_starfocus_android_LockedHardwareBuffer_lock(
    JNIEnv* env, jclass, jobject object, jboolean written, jobjectArray buffers, jintArray layout) {
  AHardwareBuffer* const buffer =
      object == nullptr ? nullptr : AHardwareBuffer_fromHardwareBuffer(env, object);
  AHardwareBuffer_Desc desc = {};
  if (buffer != nullptr) AHardwareBuffer_describe(buffer, &desc);
  const Kind kind = KindOf(desc.format);
  if (kind.pixel_bytes == 0 || desc.layers != 1) {
    ThrowArgument(env,
                  "LockedHardwareBuffer: expected one layer of RGBA_8888, RGBX_8888, RGB_888 or "
                  "YCBCR_420_888, found %u of the format %u",
                  desc.layers, desc.format);
    return 0;
  }
  const bool is_yuv = kind.format == STARFOCUS_FORMAT_YUV_420_888;
  const uint64_t usage =
      written ? AHARDWAREBUFFER_USAGE_CPU_WRITE_OFTEN : AHARDWAREBUFFER_USAGE_CPU_READ_OFTEN;
  AHardwareBuffer_Planes planes = {};
  const bool locked = AHardwareBuffer_lockPlanes(buffer, usage, -1, nullptr, &planes) == 0;
  if (!locked || planes.planeCount != (is_yuv ? 3u : 1u)) {
    if (locked) AHardwareBuffer_unlock(buffer, nullptr);
    ThrowArgument(env, "LockedHardwareBuffer: expected a buffer that the processor may %s",
                  written ? "write" : "read");
    return 0;
  }
  for (uint32_t i = 0; i < planes.planeCount; ++i) {
    const uint32_t half = i > 0 ? 1 : 0;
    const jobject plane =
        BufferOf(env, planes.planes[i], (jlong(desc.width) + half) >> half,
                 (jlong(desc.height) + half) >> half, half ? 1 : kind.pixel_bytes);
    const jint stride = static_cast<jint>(planes.planes[i].rowStride);
    env->SetIntArrayRegion(layout, static_cast<jsize>(i), 1, &stride);
    env->SetObjectArrayElement(buffers, static_cast<jsize>(i), plane);
  }
  const jint described[] = {kind.format,
                            static_cast<jint>(planes.planes[is_yuv ? 1 : 0].pixelStride)};
  env->SetIntArrayRegion(layout, 3, 2, described);
  return static_cast<jint>(planes.planeCount);
}

extern "C" JNIEXPORT void JNICALL
Java_dev_starfocus_android_LockedHardwareBuffer_unlock(JNIEnv* env, jclass, jobject object) {
  AHardwareBuffer_unlock(AHardwareBuffer_fromHardwareBuffer(env, object), nullptr);
}

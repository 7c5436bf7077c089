// SPDX-License-Identifier: Apache-2.0
// The parts of the NDK's header android/hardware_buffer.h that locked_hardware_buffer.cc uses,
// according to the NDK's documentation. No Debian package has this header.
#ifndef STARFOCUS_TESTS_BINDINGS_HARDWARE_BUFFER_H_
#define STARFOCUS_TESTS_BINDINGS_HARDWARE_BUFFER_H_

#include <stdint.h>

#ifndef __INTRODUCED_IN
#define __INTRODUCED_IN(level)
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum {
  AHARDWAREBUFFER_FORMAT_R8G8B8A8_UNORM = 1,
  AHARDWAREBUFFER_FORMAT_R8G8B8X8_UNORM = 2,
  AHARDWAREBUFFER_FORMAT_R8G8B8_UNORM = 3,
  AHARDWAREBUFFER_FORMAT_Y8Cb8Cr8_420 = 0x23
};
enum { AHARDWAREBUFFER_USAGE_CPU_READ_OFTEN = 3, AHARDWAREBUFFER_USAGE_CPU_WRITE_OFTEN = 3 << 4 };

typedef struct AHardwareBuffer AHardwareBuffer;
typedef struct ARect ARect;

typedef struct AHardwareBuffer_Desc {
  uint32_t width, height, layers, format;
  uint64_t usage;
  uint32_t stride, rfu0;
  uint64_t rfu1;
} AHardwareBuffer_Desc;

typedef struct AHardwareBuffer_Plane {
  void* data;
  uint32_t pixelStride, rowStride;
} AHardwareBuffer_Plane;

typedef struct AHardwareBuffer_Planes {
  uint32_t planeCount;
  AHardwareBuffer_Plane planes[4];
} AHardwareBuffer_Planes;

void AHardwareBuffer_describe(const AHardwareBuffer* buffer, AHardwareBuffer_Desc* desc);
int AHardwareBuffer_lockPlanes(AHardwareBuffer* buffer, uint64_t usage, int32_t fence,
                               const ARect* rectangle, AHardwareBuffer_Planes* planes);
int AHardwareBuffer_unlock(AHardwareBuffer* buffer, int32_t* fence);

#ifdef __cplusplus
}
#endif

#endif  // STARFOCUS_TESTS_BINDINGS_HARDWARE_BUFFER_H_

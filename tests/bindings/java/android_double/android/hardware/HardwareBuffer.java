// SPDX-License-Identifier: Apache-2.0
package android.hardware;

import java.nio.ByteBuffer;

/**
   The parts of Android's HardwareBuffer that the native functions for hardware buffers use in the
   tests.
 */
public final class HardwareBuffer {
  public final int width, height, format, rowStride, pixelStride;
  /** Chroma, if present, follows luma. U and V are two bytes apart, in rows of the same stride. */
  public final ByteBuffer memory;
  public int locks;

  public HardwareBuffer(int width, int height, int format, int rowStride, int pixelStride) {
    this.width = width;
    this.height = height;
    this.format = format;
    this.rowStride = rowStride;
    this.pixelStride = pixelStride;
    memory = ByteBuffer.allocateDirect(2 * rowStride * height);
  }
}

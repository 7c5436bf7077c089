// SPDX-License-Identifier: Apache-2.0
package dev.starfocus.android;

import android.hardware.HardwareBuffer;
import dev.starfocus.Image;
import dev.starfocus.Refocuser;
import java.nio.ByteBuffer;
import java.util.Arrays;

/**
 * Locks a HardwareBuffer until this object is closed. The field {@link #image} refers to the locked
 * pixels, for reading or for writing. The buffer must have the format RGBA_8888, RGBX_8888, RGB_888
 * or YCBCR_420_888, and must have been created with USAGE_CPU_READ_OFTEN or USAGE_CPU_WRITE_OFTEN.
 * Images of YCBCR_420_888 have full range and the matrix BT.601, as Android's cameras produce them.
 */
public final class LockedHardwareBuffer implements AutoCloseable {
  static {
    Refocuser.version(); // loads the library
  }

  /** The locked pixels, which must not be used after {@link #close}. */
  public final Image image;
  private HardwareBuffer buffer;

  /**
   * Locks a buffer.
   *
   * @param buffer buffer with one layer
   * @param written true to write the pixels, false to read them
   * @throws IllegalArgumentException if the buffer is null, has an unsupported format, has several
   *     layers, or cannot be locked
   */
  public LockedHardwareBuffer(HardwareBuffer buffer, boolean written) {
    final ByteBuffer[] planes = new ByteBuffer[3];
    final int[] layout = new int[5];
    final int count = lock(buffer, written, planes, layout);
    image = new Image(layout[3], Arrays.copyOf(planes, count), Arrays.copyOf(layout, count));
    image.pixelStride = layout[4];
    image.range = Image.FULL;
    this.buffer = buffer;
  }

  /**
   * Unlocks the buffer, and waits until all written pixels have reached the buffer. No-op if the
   * buffer is already unlocked.
   */
  @Override
  public void close() {
    if (buffer != null)
      unlock(buffer);
    buffer = null;
  }

  /**
   * Locks the buffer and returns the number of planes.
   *
   * @param planes receives up to three planes
   * @param layout receives three strides in bytes, the format, and the pixel stride
   */
  private static native int lock(
      HardwareBuffer buffer, boolean written, ByteBuffer[] planes, int[] layout);

  private static native void unlock(HardwareBuffer buffer);
}

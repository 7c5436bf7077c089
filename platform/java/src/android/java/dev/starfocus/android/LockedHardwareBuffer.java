// SPDX-License-Identifier: Apache-2.0
package dev.starfocus.android;

import android.hardware.HardwareBuffer;
import dev.starfocus.Image;
import dev.starfocus.Refocuser;
import java.nio.ByteBuffer;
import java.util.Arrays;

/**
 * What a HardwareBuffer holds where it is, as an {@link Image}, to be read or written until it is
 * closed. It has been made for that (USAGE_CPU_READ_OFTEN, USAGE_CPU_WRITE_OFTEN) and is of
 * RGBA_8888, RGBX_8888, RGB_888 or YCBCR_420_888; of that the image has full range and BT.601, what
 * Android's cameras give.
 */
public final class LockedHardwareBuffer implements AutoCloseable {
  static {
    Refocuser.version(); // loads the library
  }

  public final Image image;
  private HardwareBuffer buffer;

  /** To be written where `written` is true, else to be read. */
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
   * Gives the memory back and waits until what was written is there; the image must not be used
   * any more.
   */
  @Override
  public void close() {
    if (buffer != null)
      unlock(buffer);
    buffer = null;
  }

  /** Returns how many planes there are. `layout` becomes three strides, format and pixel stride. */
  private static native int lock(
      HardwareBuffer buffer, boolean written, ByteBuffer[] planes, int[] layout);

  private static native void unlock(HardwareBuffer buffer);
}

// SPDX-License-Identifier: Apache-2.0
package android.graphics;

import java.nio.ByteBuffer;

/** The parts of Android's Bitmap that the native functions for bitmaps use in the tests. */
public final class Bitmap {
  public final int width, height, stride, format;
  public final ByteBuffer pixels;
  public int locks;

  public Bitmap(int width, int height, int stride, int format) {
    this.width = width;
    this.height = height;
    this.stride = stride;
    this.format = format;
    pixels = ByteBuffer.allocateDirect(stride * height);
  }
}

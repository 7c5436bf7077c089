// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/**
 * A picture in direct buffers, which are read and written where they are: the C structure
 * starfocus_image of image.h. A plane begins at its buffer's position and ends before its limit, as
 * they are when the image is made.
 */
public final class Image {
  public static final int RGB = 0, BGR = 1, RGBX = 2, BGRX = 3;
  public static final int NV12 = 4, NV21 = 5, I420 = 6, YUV_420_888 = 7;
  public static final int BT601 = 0, BT709 = 1;
  public static final int LIMITED = 0, FULL = 1;

  /** One of RGB to YUV_420_888. */
  public final int format;
  /** BT601, the default, or BT709. */
  public int matrix = BT601;
  /** LIMITED, the default, or FULL, as Android's cameras have it. */
  public int range = LIMITED;
  /**
   * Bytes between pixels of R, G, B, or chroma samples; 0, the default: the least that the format
   * allows.
   */
  public int pixelStride;

  final ByteBuffer[] planes;
  final int[] strides;

  /** Of R, G, B with rows `stride` bytes apart. */
  public Image(int format, ByteBuffer pixels, int stride) {
    this(format, new ByteBuffer[] {pixels}, new int[] {stride});
  }

  /** Of these planes with rows `strides` bytes apart. */
  public Image(int format, ByteBuffer[] planes, int[] strides) {
    if (planes.length != strides.length) {
      throw new IllegalArgumentException("Image: expected as many strides as planes, found "
          + strides.length + " and " + planes.length);
    }
    this.format = format;
    this.planes = new ByteBuffer[planes.length];
    for (int i = 0; i < planes.length; ++i) this.planes[i] = DirectBuffers.from(planes[i], "Image");
    this.strides = strides.clone();
  }

  void checkWritable() {
    for (ByteBuffer plane : planes) {
      if (plane.isReadOnly()) {
        throw new IllegalArgumentException("out: expected writable buffers");
      }
    }
  }
}

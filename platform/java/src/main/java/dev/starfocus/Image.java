// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/**
 * A picture with 8 bits per sample in direct buffers: the C structure starfocus_image. The engine
 * reads and writes the buffers in place. A plane starts at the position of its buffer and ends
 * before its limit; later changes of position and limit have no effect. The picture has the size of
 * the {@link Configuration} or of the region.
 */
public final class Image {
  /** Formats with one plane, named by the order of bytes in memory. X is alpha. */
  public static final int RGB = 0, BGR = 1, RGBX = 2, BGRX = 3;
  /**
   * Formats with planes of Y and chroma. Chroma planes have half the width and height of the
   * picture, rounded up. NV12: Y; U and V interleaved. NV21: Y; V and U interleaved. I420: Y; U; V.
   * YUV_420_888: Y; U; V, with chroma samples 1 or 2 bytes apart, as Android's cameras store them.
   */
  public static final int NV12 = 4, NV21 = 5, I420 = 6, YUV_420_888 = 7;
  /** Values of {@link #matrix}: ITU-R BT.601 and BT.709. */
  public static final int BT601 = 0, BT709 = 1;
  /** Values of {@link #range}: luma codes from 16 to 235, or codes from 0 to 255. */
  public static final int LIMITED = 0, FULL = 1;

  /** Layout of the picture: one of the constants RGB to YUV_420_888. */
  public final int format;
  /** {@link #BT601}, the default, or {@link #BT709}. Ignored for RGB formats. */
  public int matrix = BT601;
  /**
   * {@link #LIMITED}, the default, or {@link #FULL}, as in JPEG and Android's cameras. Ignored for
   * RGB formats.
   */
  public int range = LIMITED;
  /**
   * Bytes from pixel to pixel of an RGB format, at most 256, or from chroma sample to chroma sample
   * of YUV_420_888, 1 or 2. 0, the default: the smallest value that the format allows.
   */
  public int pixelStride;

  final ByteBuffer[] planes;
  final int[] strides;

  /**
   * Describes a picture with one plane.
   *
   * @param format {@link #RGB}, {@link #BGR}, {@link #RGBX} or {@link #BGRX}
   * @param pixels direct buffer with the pixels
   * @param stride bytes from row to row, at least one row
   * @throws IllegalArgumentException if the buffer is not direct
   */
  public Image(int format, ByteBuffer pixels, int stride) {
    this(format, new ByteBuffer[] {pixels}, new int[] {stride});
  }

  /**
   * Describes a picture with several planes.
   *
   * @param format one of the constants RGB to YUV_420_888
   * @param planes direct buffers, as many as the format has planes
   * @param strides bytes from row to row of each plane, at least one row
   * @throws IllegalArgumentException if a buffer is not direct, or the numbers of planes and
   *     strides differ
   */
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

// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/**
 * A picture with 8 bits per sample in direct buffers: the C structure starfocus_image. The engine
 * reads and writes the buffers in place. A plane starts at the position of its buffer and ends at
 * or before the limit; later changes of position and limit have no effect. The size of the picture
 * is the size in the {@link Configuration}, or the size of the region.
 */
public final class Image {
  /** Formats with one plane, named by the order of bytes in memory. The letter X means alpha. */
  public static final int RGB = 0, BGR = 1, RGBX = 2, BGRX = 3;
  /**
   * Formats with a plane of luma (Y) and one or two planes of chroma (U, V). Chroma planes have
   * half the width and height of the picture, rounded up. NV12 has a plane of Y, and a plane with U
   * and V interleaved. NV21 has a plane of Y, and a plane with V and U interleaved. I420 has three
   * planes: Y, U and V. YUV_420_888 has three planes, with chroma samples 1 or 2 bytes apart, as
   * Android's cameras store them.
   */
  public static final int NV12 = 4, NV21 = 5, I420 = 6, YUV_420_888 = 7;
  /** Values of {@link #matrix}: the YUV matrices of ITU-R BT.601 and BT.709. */
  public static final int BT601 = 0, BT709 = 1;
  /** Values of {@link #range}. LIMITED: luma codes from 16 to 235. FULL: codes from 0 to 255. */
  public static final int LIMITED = 0, FULL = 1;

  /** Format of the picture: a constant from {@link #RGB} to {@link #YUV_420_888}. */
  public final int format;
  /** YUV matrix: {@link #BT601}, the default, or {@link #BT709}. Ignored for RGB formats. */
  public int matrix = BT601;
  /**
   * Range of YUV codes: {@link #LIMITED}, the default, or {@link #FULL}, which JPEG files and
   * Android's cameras use. Ignored for RGB formats.
   */
  public int range = LIMITED;
  /**
   * Distance in bytes between pixels of an RGB format, at most 256, or between chroma samples of
   * YUV_420_888, 1 or 2. 0, the default, means the smallest value that the format allows.
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
      throw new IllegalArgumentException(
          "Image: expected equal numbers of strides and planes, found " + strides.length + " and "
          + planes.length);
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

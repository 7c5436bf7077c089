// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/**
 * Depths of the centre view in a direct buffer of the machine's byte order, as large as the picture
 * or smaller: the C structure starfocus_depth_map of image.h.
 */
public final class DepthMap {
  public static final int FLOAT = 0, U16 = 1, U8 = 2, HALF = 3;
  public static final int LINEAR = 0, RECIPROCAL = 1;

  public final int type, width, height;
  /** Disparity is scale * z + offset (LINEAR, the default) or scale / z + offset (RECIPROCAL). */
  public int meaning = LINEAR;
  public double scale = 1, offset;
  /** 1: `invalid` stands for an unknown depth; 0, the default: no value does. */
  public int hasInvalid;
  public double invalid;

  final ByteBuffer values;
  final int stride;

  /** Of width times height values of `type`, rows `stride` bytes apart. */
  public DepthMap(int type, ByteBuffer values, int stride, int width, int height) {
    this.type = type;
    this.values = DirectBuffers.from(values, "DepthMap");
    this.stride = stride;
    this.width = width;
    this.height = height;
  }
}

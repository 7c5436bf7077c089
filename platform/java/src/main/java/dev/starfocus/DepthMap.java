// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/**
 * Depth map of the centre view, which may have fewer pixels than the picture: the C structure
 * starfocus_depth_map. The values of the map are in a direct buffer in the native byte order.
 * Aligned rows are read in place. Calls copy maps whose rows are not aligned or are stored from
 * bottom to top.
 */
public final class DepthMap {
  /**
   * Types of the values of a map: 32-bit float, 16-bit unsigned integer, 8-bit unsigned integer,
   * 16-bit float, and the 16-bit integers of {@code ImageFormat.DEPTH16} of Android. A value of
   * DEPTH16 is a distance in millimetres in the lower 13 bits, where 0 is unknown; its confidence
   * is ignored. Use DEPTH16 with {@link #RECIPROCAL}.
   */
  public static final int FLOAT = 0, U16 = 1, U8 = 2, HALF = 3, DEPTH16 = 4;
  /** Values of {@link #meaning}. */
  public static final int LINEAR = 0, RECIPROCAL = 1;

  /** Type of the values, and width and height of the map in values. */
  public final int type, width, height;
  /**
   * Conversion of a value z to a disparity. With {@link #LINEAR}, the default, the disparity is
   * scale * z + offset. With {@link #RECIPROCAL}, z is a distance, and the disparity is scale / z +
   * offset.
   */
  public int meaning = LINEAR;
  /**
   * Coefficients of the conversion {@link #meaning}, rounded to float. Both coefficients must be
   * finite, and scale must not be 0. The defaults are a scale of 1 and an offset of 0.
   */
  public double scale = 1, offset;
  /**
   * If 1, values equal to {@link #invalid} are unknown. If 0, the default, {@link #invalid} is not
   * used.
   */
  public int hasInvalid;
  /** Value that stands for unknown depth if {@link #hasInvalid} is 1; rounded to float. */
  public double invalid;

  final ByteBuffer values;
  final int stride;

  /**
   * Describes a depth map. The values in the buffer must not change while a call reads the map.
   *
   * @param type {@link #FLOAT}, {@link #U16}, {@link #U8}, {@link #HALF} or {@link #DEPTH16}
   * @param values direct buffer; the map starts at its position
   * @param stride bytes from row to row, at least one row. If the stride is negative, the rows are
   *     stored from bottom to top: the buffer starts with the bottom row
   * @param width width in values, 1 to the width of the picture
   * @param height height in values, 1 to the height of the picture
   * @throws IllegalArgumentException if the buffer is not direct
   */
  public DepthMap(int type, ByteBuffer values, int stride, int width, int height) {
    this.type = type;
    this.values = DirectBuffers.from(values, "DepthMap");
    this.stride = stride;
    this.width = width;
    this.height = height;
  }
}

// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/**
 * Configuration of a {@link Refocuser}: the fields of the C structure starfocus_config. A Refocuser
 * copies the values, so later changes of the Configuration have no effect on the Refocuser. The
 * constructor of Refocuser throws an exception for values out of range.
 */
public final class Configuration {
  /**
   * Values of {@link #transfer}. SRGB means that samples encode light by the sRGB curve. NONE means
   * that samples are proportional to light.
   */
  public static final int TRANSFER_SRGB = 0, TRANSFER_NONE = 1;

  /** Width and height of the views in pixels, 1 to 65535. Must be set. */
  public int width, height;
  /**
   * Number of captured views: 1, 5, 9 or 17 if {@link #positions} is null, otherwise 1 to 17.
   * Default 5.
   */
  public int views;
  /**
   * Positions of the views: u and v of each view, each from -1 to 1. The first view lies at (0, 0),
   * and no two positions are equal. Null, the default, means the positions of {@link
   * Refocuser#viewPosition}.
   */
  public double[] positions;
  /**
   * Smallest and largest disparity that a map may contain, in pixels per unit of u, within +-500.
   * Default 0.
   */
  public double disparityMin, disparityMax;
  /**
   * Upper limit of the blur radius aperture * |disparity - focus| in pixels, above 0 and at most
   * 128. Default 32. The limit determines how much memory the engine requires, but does not affect
   * the pictures.
   */
  public double maxBlur;
  /**
   * Number of threads, at most 64. 0, the default, means one thread for each big core of the
   * machine.
   */
  public int workers;

  /**
   * Side of the superblocks in pixels: 32, 64, 128, 256 or 0. The engine splits superblocks into
   * blocks. 0, the default, means 128.
   */
  public int superblock;
  /**
   * Factor by which the number of views along the radius of the aperture is multiplied, 0.5 to 2.
   * Default 1. The factor affects the modes {@link Parameters#MODE_BLOCK} and {@link
   * Parameters#MODE_FRAME}.
   */
  public double nScale;
  /** Relation of samples to light: {@link #TRANSFER_SRGB}, the default, or TRANSFER_NONE. */
  public int transfer;
  /**
   * Brightness that the engine assumes for clipped light sources, relative to white, 1 to 64.
   * Default 1.
   */
  public double highlights;
  /**
   * If not 0, unknown disparities (NaN, infinite, or the invalid value of the {@link DepthMap}) are
   * filled from their neighbours. If 0, the default, unknown disparities are an error.
   */
  public int fillUnknown;
  /**
   * If not 0, lenses may be polygons and have cat's eyes, which requires larger tables. If 0, the
   * default, polygons and cat's eyes are an error.
   */
  public int shapes;
  /**
   * Largest shift of {@link Refocuser#preview}, 0 to 3. 0, the default, disables previews.
   */
  public int previews;

  /** Creates a configuration with the default values. */
  public Configuration() {
    Native.initialize(this);
  }
}

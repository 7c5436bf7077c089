// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/**
 * What a {@link Refocuser} is made for: fields of the C structure starfocus_config, of which
 * starfocus.h has the units and ranges. They begin with its defaults; width, height and the range
 * of disparities must be filled in.
 */
public final class Configuration {
  public static final int TRANSFER_SRGB = 0, TRANSFER_NONE = 1;

  /** Size of the pictures in pixels. */
  public int width, height;
  /** Captured views: 1, 5, 9 or 17, or with positions any number from 1 to 17. */
  public int views;
  /**
   * Where the views lie: u and v of one after the other, each from -1 to 1, the centre (0, 0)
   * first. Null, the default: where {@link Refocuser#viewPosition} tells.
   */
  public double[] positions;
  /** What disparity maps may hold. */
  public double disparityMin, disparityMax;
  /** Largest blur radius in pixels that will be asked for. */
  public double maxBlur;
  /** Threads that refocus; 0, the default: one for each big core. */
  public int workers;

  public int superblock;
  public double nScale;
  public int transfer;
  public double highlights;
  /**
   * Not 0: disparities that are not finite, and invalid depths, are unknown; 0: they are refused.
   */
  public int fillUnknown;
  /**
   * Not 0: lenses may be polygons and have cat's eyes, for which memory is reserved; 0, the
   * default: they are refused.
   */
  public int shapes;
  /** Largest shift of {@link Refocuser#preview}, 0 to 3; 0, the default: there are no previews. */
  public int previews;

  public Configuration() {
    Native.initialize(this);
  }
}

// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/**
 * Parameters of a refocus call: the fields of the C structures starfocus_params and
 * starfocus_study. The parameters may be changed between calls. A call throws an exception for
 * values out of range, even in fields that the shape of the lens does not use.
 */
public final class Parameters {
  /**
   * Values of {@link #mode}. FRAME uses one number of views for the whole picture. BENCHMARK uses
   * one number of views for the whole picture, which is larger than with FRAME. BLOCK uses blocks
   * of different sizes, each with its own number of views. BLUR blurs the centre view and uses no
   * other views.
   */
  public static final int MODE_FRAME = 0, MODE_BENCHMARK = 1, MODE_BLOCK = 2, MODE_BLUR = 3;
  /**
   * Values of {@link #shape}. FALL_OFF is a disc that is darker towards its rim. DISC is a disc of
   * constant brightness. POLYGON is a polygon, like the opening of a diaphragm with blades. RING is
   * a disc with a round hole in its middle.
   */
  public static final int SHAPE_FALL_OFF = 0, SHAPE_DISC = 1, SHAPE_POLYGON = 2, SHAPE_RING = 3;
  /**
   * Values of {@link #renderer}. AUTO means LINE_SCAN for MODE_FRAME with 5 or more views at the
   * positions of {@link Refocuser#viewPosition}, otherwise SLICES. LINE_SCAN is the line-scan
   * method of the paper that docs/method.md cites, and requires views at the positions of {@link
   * Refocuser#viewPosition}. SLICES composites depth slices, which requires fewer views than
   * LINE_SCAN.
   */
  public static final int RENDERER_AUTO = 0, RENDERER_LINE_SCAN = 1, RENDERER_SLICES = 2;

  /**
   * Mode of rendering, by default {@link #MODE_BLOCK}, and renderer of views, by default {@link
   * #RENDERER_AUTO}.
   */
  public int mode, renderer;
  /** Disparity in focus, in pixels per unit of u, within +-1000000. Default 0. */
  public double focus;
  /**
   * Extents of the range in focus on the near and on the far side of {@link #focus}. Disparities
   * from focus - focusFarther to focus + focusNearer are sharp, and blur grows with the distance
   * from this range. Both extents are at least 0, and both ends of the range are within +-1000000.
   * Default 0.
   */
  public double focusNearer, focusFarther;
  /** Radius of the aperture, 0 to 1. 0 gives the centre view. Default 1. */
  public double aperture;
  /**
   * Shape of the aperture; default {@link #SHAPE_FALL_OFF}. Polygons require {@link
   * Configuration#shapes}.
   */
  public int shape;
  /** Number of corners of a polygon, 3 to 12. Default 5. */
  public int blades;
  /**
   * Parameters of the shape of the aperture.
   *
   * <ul>
   *   <li>theta: fall-off, the angle in radians, 0.05 pi to 0.45 pi; default 0.26 pi.
   *   <li>rotation: polygon, clockwise rotation in degrees, -360 to 360; default 0, a corner points
   *       up.
   *   <li>curvature: polygon, from 0, the default (straight edges), to 1 (a disc).
   *   <li>ringInner: ring, radius of the hole divided by the radius of the disc, 0 to 0.9; default
   *       0.5.
   *   <li>catsEye: distance of a second rim from the axis, in radii of the lens, as seen from a
   *       corner of the picture, 0 to 1; default 0. Values of catsEye above 0 require {@link
   *       Configuration#shapes}.
   * </ul>
   */
  public double theta, rotation, curvature, ringInner, catsEye;
  /**
   * Part of the picture to compute, in pixels. The output has the same bytes as the region of the
   * whole picture. If all four fields are 0, the default, the region is the whole picture.
   */
  public int regionX, regionY, regionWidth, regionHeight;

  /** Creates parameters with the default values. */
  public Parameters() {
    Native.initialize(this);
  }
}

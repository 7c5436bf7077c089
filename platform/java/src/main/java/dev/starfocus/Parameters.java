// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/**
 * Parameters of one refocusing: the fields of the C structures starfocus_params and
 * starfocus_lens. The values may change from call to call. Values out of range are reported by the
 * call that receives the parameters, including values of fields that the shape of the lens does not
 * use.
 */
public final class Parameters {
  /**
   * Values of {@link #mode}. FRAME: one number of views for the whole picture. BENCHMARK: as FRAME,
   * with more views. BLOCK: blocks of different sizes, each with its own number of views. BLUR: the
   * blurred centre view, without other views.
   */
  public static final int MODE_FRAME = 0, MODE_BENCHMARK = 1, MODE_BLOCK = 2, MODE_BLUR = 3;
  /**
   * Values of {@link #shape}. FALL_OFF: a disc that is darker towards its rim. DISC: a disc of
   * constant brightness. POLYGON: a polygon, as of a shutter with blades. RING: a disc with a hole.
   */
  public static final int SHAPE_FALL_OFF = 0, SHAPE_DISC = 1, SHAPE_POLYGON = 2, SHAPE_RING = 3;
  /**
   * Values of {@link #renderer}. AUTO: line scan for MODE_FRAME of a star of 5 or more views,
   * slices otherwise. LINE_SCAN: the paper's line scan, which requires the views of {@link
   * Refocuser#viewPosition}. SLICES: slices of the scene, with fewer views.
   */
  public static final int RENDERER_AUTO = 0, RENDERER_LINE_SCAN = 1, RENDERER_SLICES = 2;

  /**
   * How the picture is divided ({@link #MODE_BLOCK}, the default) and how views are rendered
   * ({@link #RENDERER_AUTO}, the default).
   */
  public int mode, renderer;
  /** Disparity in focus, in pixels per unit of u, within +-1000000. Default 0. */
  public double focus;
  /** Radius of the aperture, 0 to 1. 0 gives the centre view. Default 1. */
  public double aperture;
  /**
   * Shape of the aperture; default {@link #SHAPE_FALL_OFF}. Polygons require {@link
   * Configuration#shapes}.
   */
  public int shape;
  /** Polygon: number of corners, 3 to 12. Default 5. */
  public int blades;
  /**
   * Details of the shape.
   *
   * <ul>
   *   <li>theta: fall-off, the angle in radians, 0.05 pi to 0.45 pi; default 0.26 pi.
   *   <li>rotation: polygon, clockwise rotation in degrees, -360 to 360; default 0, a corner points
   *       up.
   *   <li>curvature: polygon, from 0, the default (straight edges), to 1 (a disc).
   *   <li>ringInner: ring, radius of the hole divided by the radius of the disc, 0 to 0.9; default
   *       0.5.
   *   <li>catsEye: distance of a second rim from the axis, in radii of the lens, as seen from a
   *       corner of the picture, 0 to 1; default 0. Values above 0 require {@link
   *       Configuration#shapes}.
   * </ul>
   */
  public double theta, rotation, curvature, ringInner, catsEye;
  /**
   * Part of the picture to compute, in pixels. The output has the same bytes as this part of the
   * whole picture. All 0, the default: the whole picture.
   */
  public int regionX, regionY, regionWidth, regionHeight;

  /** Creates parameters with the default values. */
  public Parameters() {
    Native.initialize(this);
  }
}

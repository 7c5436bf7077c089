// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/**
 * What to render: fields of the C structures starfocus_params and starfocus_lens, of which
 * starfocus.h has the units and ranges.
 */
public final class Parameters {
  public static final int MODE_FRAME = 0, MODE_BENCHMARK = 1, MODE_BLOCK = 2, MODE_BLUR = 3;
  public static final int SHAPE_FALL_OFF = 0, SHAPE_DISC = 1, SHAPE_POLYGON = 2, SHAPE_RING = 3;
  public static final int RENDERER_AUTO = 0, RENDERER_LINE_SCAN = 1, RENDERER_SLICES = 2;

  public int mode, renderer;
  /** Disparity in focus. */
  public double focus;
  /** Radius of the lens, from 0 (the centre view itself) to 1, the default. */
  public double aperture;
  /** Opening of the lens. Polygons and cat's eyes need {@link Configuration#shapes}. */
  public int shape;
  public int blades;
  public double theta, rotation, curvature, ringInner, catsEye;
  /** Only this part of the picture, in pixels; all 0, the default: the whole one. */
  public int regionX, regionY, regionWidth, regionHeight;

  public Parameters() {
    Native.initialize(this);
  }
}

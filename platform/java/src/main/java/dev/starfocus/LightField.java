// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/** A light field: the captured views, the depth map of the centre view, and optionally coverage. */
public final class LightField {
  final Image[] views;
  final DepthMap depth;
  final ByteBuffer coverage;
  final int coverageStride;

  /**
   * Creates a light field. The light field keeps references to the images and the map, and copies
   * no pixels.
   *
   * @param views the configured number of views, in the order of {@link Refocuser#viewPosition} or
   *     {@link Configuration#positions}; the centre view is the first. Views may differ in their
   *     format
   * @param depth depth map of the centre view
   */
  public LightField(Image[] views, DepthMap depth) {
    this(views, depth, null, 0);
  }

  /**
   * Creates a light field with coverage: alpha of the foreground in the centre view, as matting
   * networks compute it. The coverage of a pixel is the part that the nearer of two surfaces
   * covers, 255 for all of the pixel. Near depth edges, coverage takes precedence over the map.
   *
   * @param views as above
   * @param depth as above
   * @param coverage direct buffer with one byte per pixel, which starts at its position; null for
   *     no coverage
   * @param coverageStride bytes from row to row, at least the width of the picture
   * @throws IllegalArgumentException if the buffer is not direct
   */
  public LightField(Image[] views, DepthMap depth, ByteBuffer coverage, int coverageStride) {
    this.views = views.clone();
    this.depth = depth;
    this.coverage = coverage == null ? null : DirectBuffers.from(coverage, "coverage");
    this.coverageStride = coverageStride;
  }
}

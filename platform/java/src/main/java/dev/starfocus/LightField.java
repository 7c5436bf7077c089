// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/** A light field: the captured views, and the depth map of the centre view. */
public final class LightField {
  final Image[] views;
  final DepthMap depth;

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
    this.views = views.clone();
    this.depth = depth;
  }
}

// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/**
 * Views in the order that {@link Refocuser#viewPosition} or {@link Configuration#positions} tells,
 * the centre first, and the depth of the first one.
 */
public final class LightField {
  final Image[] views;
  final DepthMap depth;

  public LightField(Image[] views, DepthMap depth) {
    this.views = views.clone();
    this.depth = depth;
  }
}

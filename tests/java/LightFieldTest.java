// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import static dev.starfocus.RefocuserTest.*;

import java.nio.ByteBuffer;

/** Tests light fields: depth maps of every kind and layout, and coverage. */
final class LightFieldTest {
  private LightFieldTest() {}

  private static void smallMapsAreMeasuredAndTapped() {
    final ByteBuffer distances = bytes(2 * 40 * 30); // 4000 in the left half, 500 in the right half
    for (int i = 0; i < 40 * 30; ++i) distances.putShort(2 * i, (short) (i % 40 < 20 ? 4000 : 500));
    distances.putShort(0, (short) 0);
    final DepthMap depth = new DepthMap(DepthMap.U16, distances, 80, 40, 30);
    depth.meaning = DepthMap.RECIPROCAL;
    depth.scale = 8000;
    depth.hasInvalid = 1;
    final double[] range = Refocuser.measureDisparity(depth);
    check(range.length == 2 && range[0] == 2 && range[1] == 16, "range of a map of distances");
    final Configuration configuration = configuration();
    configuration.disparityMin = range[0];
    configuration.disparityMax = range[1];
    configuration.maxBlur = 7;
    check(Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH / 2 - 1, 10) == 2, "focus at the left");
    check(Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH / 2, 10) == 16, "focus at the right half");
    check(Refocuser.focusAt(depth, WIDTH, HEIGHT, 0, 0) == 2, "focus at an unknown value");
    checkThrows(
        StarfocusException.class, "", () -> Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH, 10));
    checkThrows(StarfocusException.class, "", () -> Refocuser.focusAt(depth, 10, 0, 5, 5));
    try (Refocuser refocuser = new Refocuser(configuration)) {
      final Parameters parameters = new Parameters();
      parameters.focus = 2;
      check(refocuser.largestAperture(parameters) == 0.5, "the largest aperture");
      parameters.focus = 1e9;
      checkThrows(StarfocusException.class, "focus", () -> refocuser.largestAperture(parameters));
    }
    depth.scale = 0;
    checkThrows(StarfocusException.class, "", () -> Refocuser.measureDisparity(depth));
  }

  static void run() {
    smallMapsAreMeasuredAndTapped();
  }
}

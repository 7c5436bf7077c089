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
    checkThrows(StarfocusException.class, "(expected inside the picture, found 160)",
        () -> Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH, 10));
    checkThrows(
        StarfocusException.class, "y: ", () -> Refocuser.focusAt(depth, WIDTH, HEIGHT, 10, -1));
    checkThrows(StarfocusException.class, "width: ", () -> Refocuser.focusAt(depth, 39, 30, 5, 5));
    checkThrows(StarfocusException.class, "(expected 1 to 65535, found 0)",
        () -> Refocuser.focusAt(depth, 40, 0, 5, 5));
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

  /**
   * Returns a picture of a light field with one view, refocused in one call and after prepare().
   */
  private static ByteBuffer refocusedBothWays(LightField field, String what) {
    final ByteBuffer once = bytes(3 * WIDTH * HEIGHT), prepared = bytes(3 * WIDTH * HEIGHT);
    final Parameters parameters = new Parameters();
    parameters.focus = 1;
    try (Refocuser refocuser = new Refocuser(configuration())) {
      refocuser.refocus(field, parameters, out(once));
      refocuser.prepare(field);
      refocuser.refocusPrepared(parameters, out(prepared));
    }
    check(once.equals(prepared), what + ": prepared, the picture is the same");
    return once;
  }

  private static Image[] view() {
    return new Image[] {new Image(Image.RGB, picture(), 3 * WIDTH)};
  }

  /** Returns a copy of the rows of a map after `gap` bytes, `stride` bytes apart. */
  private static ByteBuffer rows(ByteBuffer map, int row, int stride, int gap) {
    final int height = map.capacity() / row, step = Math.abs(stride);
    final ByteBuffer copy = bytes(gap + step * height);
    for (int y = 0; y < height; ++y) {
      final int to = gap + step * (stride < 0 ? height - 1 - y : y);
      for (int i = 0; i < row; ++i) copy.put(to + i, map.get(row * y + i));
    }
    copy.position(gap);
    return copy;
  }

  private static void mapsOfAnyStrideAreRead() {
    final ByteBuffer floats = ramp(), codes = bytes(2 * WIDTH * HEIGHT);
    for (int y = 0; y < HEIGHT; ++y) floats.putFloat(4 * WIDTH * y, y % 5 - 2);
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
      codes.putShort(2 * i, (short) Math.round((floats.getFloat(4 * i) + 4) * 64));
    }
    final ByteBuffer whole = refocusedBothWays(new LightField(view(), depth(floats)), "in place");
    ByteBuffer ofCodes = null;
    for (int extra : new int[] {0, 1, 2, 3, 8, 4 * WIDTH}) {
      for (int gap : new int[] {0, 1, 2, 3, 5}) {
        for (int sign : new int[] {1, -1}) {
          final int stride = sign * (4 * WIDTH + extra), shorts = sign * (2 * WIDTH + extra);
          final String what = "a stride of " + stride + " after " + gap + " bytes";
          final DepthMap depth = new DepthMap(
              DepthMap.FLOAT, rows(floats, 4 * WIDTH, stride, gap), stride, WIDTH, HEIGHT);
          final DepthMap small = new DepthMap(
              DepthMap.U16, rows(codes, 2 * WIDTH, shorts, gap), shorts, WIDTH, HEIGHT);
          small.scale = 1 / 64.0;
          small.offset = -4;
          check(Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH - 1, 3)
                  == Refocuser.focusAt(depth(floats), WIDTH, HEIGHT, WIDTH - 1, 3),
              what + ": focus");
          check(Refocuser.measureDisparity(depth)[1] == 159 * 8F / WIDTH - 4, what + ": range");
          check(whole.equals(refocusedBothWays(new LightField(view(), depth), what)), what);
          final ByteBuffer made = refocusedBothWays(new LightField(view(), small), what);
          check(ofCodes == null || made.equals(ofCodes), what + ": codes of 16 bits");
          ofCodes = made;
        }
      }
    }
    final ByteBuffer map = ramp();
    for (int stride : new int[] {-4 * WIDTH + 1, -4, -4 * WIDTH - 1, Integer.MIN_VALUE, 4}) {
      final DepthMap wrong = new DepthMap(DepthMap.FLOAT, map, stride, WIDTH, HEIGHT);
      try {
        Refocuser.measureDisparity(wrong);
        check(false, "expected a stride of " + stride + " to be rejected");
      } catch (IllegalArgumentException | StarfocusException error) {
        check(true, "");
      }
    }
  }

  private static void coverageChangesThePicture() {
    final ByteBuffer map = ramp(), coverage = bytes(WIDTH * HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
      map.putFloat(4 * i, i % WIDTH < WIDTH / 2 ? 4 : -4);
      coverage.put(i, (byte) Math.max(0, Math.min(255, 8 * (WIDTH / 2 + 16 - i % WIDTH))));
    }
    final ByteBuffer plain = refocusedBothWays(new LightField(view(), depth(map)), "no coverage");
    check(plain.equals(
              refocusedBothWays(new LightField(view(), depth(map), null, 0), "null coverage")),
        "null is no coverage");
    final ByteBuffer covered =
        refocusedBothWays(new LightField(view(), depth(map), coverage, WIDTH), "coverage");
    check(!covered.equals(plain), "coverage changes the picture");
    final LightField wide =
        new LightField(view(), depth(map), rows(coverage, WIDTH, WIDTH + 7, 3), WIDTH + 7);
    check(covered.equals(refocusedBothWays(wide, "wide")), "coverage of any stride and position");
    checkThrows(IllegalArgumentException.class, "coverage: expected a direct buffer",
        () -> new LightField(view(), depth(map), ByteBuffer.allocate(WIDTH * HEIGHT), WIDTH));
    for (int stride : new int[] {WIDTH + 1, -WIDTH, Integer.MAX_VALUE}) {
      checkThrows(IllegalArgumentException.class, "coverage: expected a ",
          () -> refocusedBothWays(new LightField(view(), depth(map), coverage, stride), ""));
    }
    checkThrows(StarfocusException.class, "coverage",
        () -> refocusedBothWays(new LightField(view(), depth(map), coverage, WIDTH - 1), ""));
  }

  /** A map that had to be copied lives as long as its prepared light field. */
  private static void preparedCopiesStayAlive() {
    final int stride = -4 * WIDTH - 1;
    final Parameters parameters = new Parameters();
    parameters.focus = 1;
    final ByteBuffer first = bytes(3 * WIDTH * HEIGHT), later = bytes(3 * WIDTH * HEIGHT);
    try (Refocuser refocuser = new Refocuser(configuration())) {
      refocuser.prepare(new LightField(view(),
          new DepthMap(DepthMap.FLOAT, rows(ramp(), 4 * WIDTH, stride, 1), stride, WIDTH, HEIGHT)));
      refocuser.refocusPrepared(parameters, out(first));
      for (int round = 0; round < 5; ++round) {
        System.gc();
        refocuser.refocus(field(picture()), parameters, out(later));
        refocuser.refocusPrepared(parameters, out(later));
        check(first.equals(later), "the prepared light field is unchanged by other calls");
      }
      checkThrows(IllegalArgumentException.class, "depth: expected a buffer",
          ()
              -> refocuser.prepare(new LightField(
                  view(), new DepthMap(DepthMap.FLOAT, bytes(4), stride, WIDTH, HEIGHT))));
      checkThrows(IllegalStateException.class, "no light field is prepared",
          () -> refocuser.refocusPrepared(parameters, out(later)));
    }
  }

  static void run() {
    mapsOfAnyStrideAreRead();
    coverageChangesThePicture();
    preparedCopiesStayAlive();
    smallMapsAreMeasuredAndTapped();
  }
}

// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;

/**
 * Tests the parts of the Java API that the demo does not cover: buffers, errors, and threads.
 * Prints the checks that failed and exits with 1.
 */
public final class RefocuserTest {
  static final int WIDTH = 160, HEIGHT = 120;
  private static int checks, failures;

  interface Call {
    void run() throws Exception;
  }

  static void check(boolean holds, String what) {
    ++checks;
    if (holds)
      return;
    ++failures;
    System.err.println("failed: " + what);
  }

  /**
     Checks that the call throws an exception of the given class, with a message that contains
     `part`.
   */
  static void checkThrows(Class<?> kind, String part, Call call) {
    try {
      call.run();
      check(false, "expected " + kind.getName() + " (" + part + "), found nothing thrown");
    } catch (Throwable thrown) {
      final String message = String.valueOf(thrown.getMessage());
      check(kind.isInstance(thrown) && message.contains(part),
          "expected " + kind.getName() + " (" + part + "), found " + thrown);
    }
  }

  static ByteBuffer bytes(int count) {
    return ByteBuffer.allocateDirect(count).order(ByteOrder.nativeOrder());
  }

  /** Returns a picture of noise. Every call returns the same picture. */
  static ByteBuffer picture() {
    final ByteBuffer pixels = bytes(3 * WIDTH * HEIGHT);
    for (int i = 0; i < pixels.capacity(); ++i) pixels.put(i, (byte) (i * i / 7 + i / 480 * 31));
    return pixels;
  }

  /** Returns disparities from -4 on the left to 4 on the right. */
  static ByteBuffer ramp() {
    final ByteBuffer map = bytes(4 * WIDTH * HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; ++i) map.putFloat(4 * i, i % WIDTH * 8F / WIDTH - 4);
    return map;
  }

  static DepthMap depth(ByteBuffer values) {
    return new DepthMap(DepthMap.FLOAT, values, 4 * WIDTH, WIDTH, HEIGHT);
  }

  static LightField field(ByteBuffer view) {
    return new LightField(new Image[] {new Image(Image.RGB, view, 3 * WIDTH)}, depth(ramp()));
  }

  static Image out(ByteBuffer pixels) {
    return new Image(Image.RGB, pixels, 3 * WIDTH);
  }

  static Configuration configuration() {
    final Configuration made = new Configuration();
    made.width = WIDTH;
    made.height = HEIGHT;
    made.views = 1;
    made.disparityMin = -4;
    made.disparityMax = 4;
    return made;
  }

  static ByteBuffer refocused(double focus) {
    final ByteBuffer pixels = bytes(3 * WIDTH * HEIGHT);
    final Parameters parameters = new Parameters();
    parameters.focus = focus;
    try (Refocuser refocuser = new Refocuser(configuration())) {
      refocuser.refocus(field(picture()), parameters, out(pixels));
    }
    return pixels;
  }

  private static void defaultsAreTheLibrarys() {
    final Configuration made = new Configuration();
    check(made.views == 5 && made.maxBlur == 32 && made.highlights == 1 && made.workers == 0,
        "defaults of the configuration");
    final Parameters parameters = new Parameters();
    check(parameters.shape == Parameters.SHAPE_FALL_OFF && parameters.blades == 5
            && parameters.ringInner == 0.5 && parameters.catsEye == 0 && parameters.focusNearer == 0
            && parameters.focusFarther == 0,
        "defaults of the lens");
    check(Math.abs(parameters.theta - 0.26 * Math.PI) < 1e-12, "default of theta");
    check(parameters.mode == Parameters.MODE_BLOCK && parameters.aperture == 1,
        "defaults of the parameters");
  }

  private static void theLensChangesItsShape() {
    final Configuration configuration = configuration();
    configuration.shapes = 1;
    final Parameters parameters = new Parameters();
    parameters.focus = 1;
    final ByteBuffer pentagon = bytes(3 * WIDTH * HEIGHT), plain = bytes(3 * WIDTH * HEIGHT);
    try (Refocuser refocuser = new Refocuser(configuration)) {
      parameters.shape = Parameters.SHAPE_POLYGON;
      refocuser.refocus(field(picture()), parameters, out(pentagon));
      parameters.shape = Parameters.SHAPE_FALL_OFF;
      refocuser.refocus(field(picture()), parameters, out(plain));
      check(plain.equals(refocused(1)), "after a call with another shape, the picture is the same");
      check(!plain.equals(pentagon), "a pentagon changes the picture");
      parameters.blades = 65536 + 5;
      checkThrows(StarfocusException.class,
          "blades: ", () -> refocuser.refocus(field(picture()), parameters, out(plain)));
    }
    parameters.blades = 5;
    parameters.catsEye = 0.5;
    try (Refocuser refocuser = new Refocuser(configuration())) {
      checkThrows(StarfocusException.class,
          "cats_eye: ", () -> refocuser.refocus(field(picture()), parameters, out(plain)));
    }
  }

  private static void disparitiesInsideTheRangeInFocusAreSharp() {
    final ByteBuffer pixels = bytes(3 * WIDTH * HEIGHT), centre = bytes(3 * WIDTH * HEIGHT);
    final Parameters parameters = new Parameters();
    parameters.focus = 1;
    try (Refocuser refocuser = new Refocuser(configuration())) {
      parameters.aperture = 0;
      refocuser.refocus(field(picture()), parameters, out(centre));
      parameters.aperture = 1;
      parameters.focusNearer = parameters.focusFarther = 9;
      refocuser.refocus(field(picture()), parameters, out(pixels));
      check(
          pixels.equals(centre), "if all disparities are in focus, the picture is the centre view");
      parameters.focusFarther = 0;
      refocuser.refocus(field(picture()), parameters, out(pixels));
      check(!pixels.equals(centre), "the far side of the range ends at the focus");
      parameters.focusFarther = -1;
      checkThrows(StarfocusException.class,
          "focus_farther: ", () -> refocuser.refocus(field(picture()), parameters, out(pixels)));
    }
  }

  private static void everyWayGivesTheSameBytes() {
    final ByteBuffer whole = refocused(1);
    final Parameters parameters = new Parameters();
    parameters.focus = 1;
    // Each plane begins at the position of its buffer.
    final ByteBuffer far = bytes(3 * WIDTH * HEIGHT + 40);
    far.position(33);
    far.put(picture().duplicate()).position(33);
    final ByteBuffer wide = bytes((3 * WIDTH + 10) * HEIGHT);
    try (Refocuser refocuser = new Refocuser(configuration())) {
      refocuser.prepare(field(far));
      refocuser.refocusPrepared(parameters, new Image(Image.RGB, wide, 3 * WIDTH + 10));
      check(refocuser.rowsDone() == HEIGHT, "rows done");
      boolean same = true;
      for (int y = 0; y < HEIGHT; ++y) {
        for (int i = 0; i < 3 * WIDTH; ++i) {
          same &= wide.get((3 * WIDTH + 10) * y + i) == whole.get(3 * WIDTH * y + i);
        }
        for (int i = 3 * WIDTH; i < 3 * WIDTH + 10; ++i) {
          same &= wide.get((3 * WIDTH + 10) * y + i) == 0;
        }
      }
      check(same, "a prepared light field gives the same picture and keeps bytes between rows");
      parameters.regionX = 32;
      parameters.regionY = 20;
      parameters.regionWidth = 10;
      parameters.regionHeight = 5;
      final ByteBuffer part = bytes(3 * 10 * 5);
      refocuser.refocusPrepared(parameters, new Image(Image.RGB, part, 30));
      boolean equal = true;
      for (int i = 0; i < 150; ++i) {
        equal &= part.get(i) == whole.get(3 * (WIDTH * (20 + i / 30) + 32) + i % 30);
      }
      check(equal, "a region equals the same part of the picture");
    }
  }

  /**
     Refocuses views with different bytes. The views are passed in the given order, with the given
     positions.
   */
  private static ByteBuffer refocusedFrom(int[] order, double[] positions) {
    final Image[] views = new Image[order.length];
    for (int k = 0; k < order.length; ++k) {
      final ByteBuffer pixels = picture();
      for (int i = 0; i < pixels.capacity(); ++i) pixels.put(i, (byte) (pixels.get(i) + order[k]));
      views[k] = new Image(Image.RGB, pixels, 3 * WIDTH);
    }
    final Configuration configuration = configuration();
    configuration.views = order.length;
    configuration.positions = positions;
    final ByteBuffer pixels = bytes(3 * WIDTH * HEIGHT);
    try (Refocuser refocuser = new Refocuser(configuration)) {
      refocuser.refocus(new LightField(views, depth(ramp())), new Parameters(), out(pixels));
    }
    return pixels;
  }

  private static void viewsLieWhereTheyAreSaidTo() {
    final ByteBuffer star = refocusedFrom(new int[] {0, 1, 2, 3, 4}, null);
    check(star.equals(refocusedFrom(
              new int[] {0, 2, 1, 4, 3}, new double[] {0, 0, -1, 0, 1, 0, 0, -1, 0, 1})),
        "a star set with its views in another order gives the same picture");
    final ByteBuffer pair = refocusedFrom(new int[] {0, 1}, new double[] {0, 0, 1, 0});
    check(!pair.equals(star), "a pair and a star set give different pictures");
    check(!pair.equals(refocusedFrom(new int[] {0, 1}, new double[] {0, 0, 0.5, 0})),
        "a pair at half the distance gives another picture");
    checkThrows(IllegalArgumentException.class, "positions: expected 4 numbers, found 3",
        () -> refocusedFrom(new int[] {0, 1}, new double[] {0, 0, 1}));
    checkThrows(StarfocusException.class, "positions[",
        () -> refocusedFrom(new int[] {0, 1}, new double[] {0, 0, 1.5, 0}));
    checkThrows(StarfocusException.class, "views: ", () -> refocusedFrom(new int[] {0, 1}, null));
  }

  /** The tests of the C API check the pixels of previews. */
  private static void aPreviewHasItsOwnSizeAndRegion() {
    final int width = WIDTH / 2, height = HEIGHT / 2;
    final Configuration configuration = configuration();
    configuration.previews = 2;
    final Parameters parameters = new Parameters();
    final ByteBuffer found = bytes(3 * width * height), part = bytes(12);
    try (Refocuser refocuser = new Refocuser(configuration)) {
      final Image out = new Image(Image.RGB, found, 3 * width);
      checkThrows(IllegalStateException.class, "no light field is prepared",
          () -> refocuser.preview(1, parameters, out));
      refocuser.prepare(field(picture()));
      refocuser.preview(1, parameters, out);
      checkThrows(StarfocusException.class, "shift: ", () -> refocuser.preview(3, parameters, out));
      final Image small = new Image(Image.RGB, bytes(3 * width * height - 1), 3 * width);
      checkThrows(IllegalArgumentException.class, "expected a buffer of",
          () -> refocuser.preview(1, parameters, small));
      parameters.regionX = 33;
      parameters.regionY = 21;
      parameters.regionWidth = parameters.regionHeight = 2;
      refocuser.preview(1, parameters, new Image(Image.RGB, part, 6));
    }
    boolean equal = true, empty = true;
    for (int i = 0; i < 12; ++i) {
      equal &= part.get(i) == found.get(3 * (width * (10 + i / 6) + 16) + i % 6);
      empty &= part.get(i) == 0;
    }
    check(equal && !empty, "a region of a preview equals the same part of the preview");
  }

  private static void chromaOfACameraComesBack() {
    final ByteBuffer luma = bytes(WIDTH * HEIGHT), chroma = bytes(WIDTH * HEIGHT / 2);
    for (int i = 0; i < luma.capacity(); ++i) luma.put(i, (byte) 90);
    for (int i = 0; i < chroma.capacity(); ++i) chroma.put(i, (byte) (i % 2 == 0 ? 120 : 135));
    final ByteBuffer v = chroma.duplicate();
    v.position(1);
    // In Android's layout, samples of U and V are two bytes apart, and the buffer of V starts one
    // byte after the buffer of U.
    final Image camera = new Image(
        Image.YUV_420_888, new ByteBuffer[] {luma, chroma, v}, new int[] {WIDTH, WIDTH, WIDTH});
    camera.pixelStride = 2;
    camera.range = Image.FULL;
    final ByteBuffer outLuma = bytes(WIDTH * HEIGHT), outChroma = bytes(WIDTH * HEIGHT / 2);
    final Image result =
        new Image(Image.NV12, new ByteBuffer[] {outLuma, outChroma}, new int[] {WIDTH, WIDTH});
    result.range = Image.FULL;
    final ByteBuffer millimetres = bytes(2 * 40 * 30);
    for (int i = 0; i < 40 * 30; ++i) millimetres.putShort(2 * i, (short) (i % 2 * 500 | i << 13));
    final DepthMap depth = new DepthMap(DepthMap.DEPTH16, millimetres, 80, 40, 30);
    depth.meaning = DepthMap.RECIPROCAL;
    depth.scale = 1000;
    final Configuration configuration = configuration();
    configuration.fillUnknown = 1;
    try (Refocuser refocuser = new Refocuser(configuration)) {
      refocuser.refocus(new LightField(new Image[] {camera}, depth), new Parameters(), result);
    }
    check(Math.abs(outLuma.get(777) - 90) <= 1 && Math.abs(outChroma.get(776) - 120) <= 1
            && Math.abs((outChroma.get(777) & 255) - 135) <= 1,
        "a camera picture of one colour keeps the colour");
  }

  private interface Refusal {
    void check(String part, LightField field, Image out);
  }

  private static void buffersAreChecked() {
    final Parameters parameters = new Parameters();
    final int bytes = 3 * WIDTH * HEIGHT;
    final ByteBuffer late = picture(), early = picture();
    late.position(1);
    early.limit(bytes - 1);
    final LightField good = field(picture());
    final Image out = out(bytes(bytes));
    final DepthMap small =
        new DepthMap(DepthMap.FLOAT, bytes(4 * WIDTH * HEIGHT - 1), 4 * WIDTH, WIDTH, HEIGHT);
    try (Refocuser refocuser = new Refocuser(configuration())) {
      final Refusal refuses = (part, field, to)
          -> checkThrows(
              IllegalArgumentException.class, part, () -> refocuser.refocus(field, parameters, to));
      final String few = "view 0, plane 0: expected a buffer of";
      refuses.check(
          "expected a buffer of 57600 bytes at least, found 57599", good, out(bytes(bytes - 1)));
      refuses.check(few, field(bytes(bytes - 1)), out);
      refuses.check(few, field(late), out);
      refuses.check("writable", good, out(bytes(bytes).asReadOnlyBuffer()));
      refuses.check(
          "depth: expected a buffer of", new LightField(new Image[] {out(picture())}, small), out);
      refuses.check("views: expected 1, found 0", new LightField(new Image[0], depth(ramp())), out);
      refuses.check("expected 2 planes, found 1", good, new Image(Image.NV12, bytes(bytes), WIDTH));
      refuses.check("stride of 0 or more, found -1", good, new Image(Image.RGB, bytes(bytes), -1));
      checkThrows(IllegalArgumentException.class, few, () -> refocuser.prepare(field(early)));
      checkThrows(IllegalArgumentException.class, "direct", () -> out(ByteBuffer.allocate(bytes)));
      checkThrows(
          NullPointerException.class, "parameters", () -> refocuser.refocus(good, null, out));
      final Image narrow = new Image(Image.RGB, bytes(bytes), 7);
      checkThrows(
          StarfocusException.class, "stride", () -> refocuser.refocus(good, parameters, narrow));
      parameters.regionX = WIDTH;
      parameters.regionWidth = parameters.regionHeight = 1;
      checkThrows(
          StarfocusException.class, "region", () -> refocuser.refocus(good, parameters, out));
    }
  }

  /** Returns true if all bytes of the buffer outside [first, end) are still `guard`. */
  private static boolean isGuarded(ByteBuffer buffer, int first, int end, byte guard) {
    for (int i = 0; i < buffer.capacity(); ++i) {
      if ((i < first || i >= end) && buffer.get(i) != guard)
        return false;
    }
    return true;
  }

  /**
   * Calls with random arguments that are accepted must write nothing outside the buffer of the
   * output.
   */
  private static void randomArgumentsWriteNothingBeyondTheOutput() {
    final int[] odd = {0, 0, 0, 1, -1, 2, 5, 20, 119, 120, 121, 160, 161, 1 << 16,
        Integer.MAX_VALUE, Integer.MIN_VALUE};
    final int[] sizes = {0, 1, 29, 480, 900, 57599, 57600, 57600, 57600, 60000};
    final java.util.Random random = new java.util.Random(71);
    final Configuration configuration = configuration();
    configuration.previews = 3;
    configuration.maxBlur = 4;
    final byte guard = (byte) 0xEE;
    final int before = 4096, capacity = 4 * WIDTH * HEIGHT;
    final ByteBuffer backing = bytes(before + capacity);
    int done = 0, refused = 0;
    try (Refocuser refocuser = new Refocuser(configuration)) {
      final LightField field = field(picture());
      refocuser.prepare(field);
      for (int round = 0; round < 400; ++round) {
        for (int i = 0; i < backing.capacity(); ++i) backing.put(i, guard);
        final int size = sizes[random.nextInt(sizes.length)];
        final ByteBuffer pixels = backing.duplicate();
        pixels.position(before);
        pixels.limit(before + size);
        final Parameters parameters = new Parameters();
        if (random.nextInt(2) == 0) {
          parameters.regionX = odd[random.nextInt(odd.length)];
          parameters.regionY = odd[random.nextInt(odd.length)];
          parameters.regionWidth = odd[random.nextInt(odd.length)];
          parameters.regionHeight = odd[random.nextInt(odd.length)];
        }
        final int stride = random.nextInt(4) > 0 ? 3 * WIDTH : odd[random.nextInt(odd.length)];
        final Image out = new Image(random.nextInt(2), pixels, stride);
        if (random.nextInt(3) == 0)
          out.pixelStride = odd[random.nextInt(odd.length)];
        try {
          switch (random.nextInt(3)) {
            case 0:
              refocuser.refocus(field, parameters, out);
              break;
            case 1:
              refocuser.refocusPrepared(parameters, out);
              break;
            default:
              refocuser.preview(odd[random.nextInt(odd.length)], parameters, out);
          }
          ++done;
        } catch (IllegalArgumentException | StarfocusException error) {
          ++refused;
        }
        if (!isGuarded(backing, before, before + size, guard)) {
          check(false, "no byte outside the output is written in round " + round);
          return;
        }
      }
    }
    check(
        done > 30 && refused > 100, "random arguments: " + done + " done, " + refused + " refused");
  }

  private static void configurationsAndStatesAreChecked() {
    final Configuration wrong = configuration();
    wrong.views = 4;
    checkThrows(StarfocusException.class, "views", () -> new Refocuser(wrong));
    final Refocuser closed = new Refocuser(configuration());
    checkThrows(IllegalStateException.class, "no light field is prepared",
        () -> closed.refocusPrepared(new Parameters(), out(bytes(3 * WIDTH * HEIGHT))));
    closed.close();
    closed.close();
    closed.cancel();
    check(closed.rowsDone() == 0, "rowsDone() is 0 after close()");
    checkThrows(IllegalStateException.class, "closed",
        () -> closed.refocus(field(picture()), new Parameters(), out(bytes(3 * WIDTH * HEIGHT))));
    checkThrows(
        IllegalStateException.class, "closed", () -> closed.largestAperture(new Parameters()));
  }

  private static void anotherThreadCallsOff() throws InterruptedException {
    final Configuration configuration = configuration();
    configuration.workers = 2;
    final Parameters parameters = new Parameters();
    parameters.mode = Parameters.MODE_BLUR;
    final Throwable[] thrown = new Throwable[1];
    try (Refocuser refocuser = new Refocuser(configuration)) {
      final Thread work = new Thread(() -> {
        try {
          while (true) {
            refocuser.refocus(field(picture()), parameters, out(bytes(3 * WIDTH * HEIGHT)));
          }
        } catch (Throwable error) {
          thrown[0] = error;
        }
      });
      work.setDaemon(true);
      work.start();
      // A call that has not begun cannot be cancelled, so the test may take several attempts.
      for (int tries = 0; work.isAlive() && tries < 10000; ++tries) {
        refocuser.cancel();
        work.join(1);
      }
      check(
          thrown[0] instanceof StarfocusException && ((StarfocusException) thrown[0]).isCancelled(),
          "a call is cancelled by another thread: " + thrown[0]);
      parameters.mode = Parameters.MODE_BLOCK;
      parameters.focus = 1;
      final ByteBuffer pixels = bytes(3 * WIDTH * HEIGHT);
      refocuser.refocus(field(picture()), parameters, out(pixels));
      check(pixels.equals(refocused(1)),
          "after the cancellation, the next call gives the same picture");
    }
  }

  public static void main(String[] arguments) throws InterruptedException {
    defaultsAreTheLibrarys();
    theLensChangesItsShape();
    disparitiesInsideTheRangeInFocusAreSharp();
    everyWayGivesTheSameBytes();
    viewsLieWhereTheyAreSaidTo();
    aPreviewHasItsOwnSizeAndRegion();
    chromaOfACameraComesBack();
    buffersAreChecked();
    randomArgumentsWriteNothingBeyondTheOutput();
    configurationsAndStatesAreChecked();
    LightFieldTest.run();
    anotherThreadCallsOff();
    if (failures == 0)
      System.out.println(checks + " checks");
    System.exit(failures == 0 ? 0 : 1);
  }
}

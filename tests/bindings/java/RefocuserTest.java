// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.function.Consumer;

/**
 * Tests the parts of the Java API that the demo does not cover: lenses, buffers of any layout,
 * errors, and threads. Prints the checks that failed and exits with 1.
 */
public final class RefocuserTest {
  private static final int WIDTH = 160, HEIGHT = 120, SIZE = WIDTH * HEIGHT;
  private static final Class<?> OF_LIBRARY = StarfocusException.class;
  private static final Class<?> OF_BUFFER = IllegalArgumentException.class;
  private static final Class<?> OF_STATE = IllegalStateException.class;
  private static int checks, failures;

  private interface Call {
    void run() throws Exception;
  }

  private static void check(boolean holds, String what) {
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
  private static void checkThrows(Class<?> kind, String part, Call call) {
    Throwable thrown = null;
    try {
      call.run();
    } catch (Throwable error) {
      thrown = error;
    }
    check(kind.isInstance(thrown) && String.valueOf(thrown.getMessage()).contains(part),
        "expected " + kind.getName() + " (" + part + "), found " + thrown);
  }

  private static ByteBuffer bytes(int count) {
    return ByteBuffer.allocateDirect(count).order(ByteOrder.nativeOrder());
  }

  /** Returns a picture of noise. Every call with the same shift returns the same picture. */
  private static ByteBuffer picture(int shift) {
    final ByteBuffer pixels = bytes(3 * SIZE);
    for (int i = 0; i < pixels.capacity(); ++i) {
      pixels.put(i, (byte) (i * i / 7 + i / 480 * 31 + shift));
    }
    return pixels;
  }

  /** Returns disparities from -4 on the left to 4 on the right, and a few others. */
  private static ByteBuffer ramp() {
    final ByteBuffer map = bytes(4 * SIZE);
    for (int i = 0; i < SIZE; ++i) {
      map.putFloat(4 * i, i % WIDTH == 0 ? i / WIDTH % 5 - 2 : i % WIDTH * 8F / WIDTH - 4);
    }
    return map;
  }

  private static Image rgb(ByteBuffer pixels) {
    return new Image(Image.RGB, pixels, 3 * WIDTH);
  }

  private static DepthMap depth(ByteBuffer values) {
    return new DepthMap(DepthMap.FLOAT, values, 4 * WIDTH, WIDTH, HEIGHT);
  }

  private static LightField field(DepthMap depth) {
    return new LightField(new Image[] {rgb(picture(0))}, depth);
  }

  private static LightField field() {
    return field(depth(ramp()));
  }

  private static LightField fieldOf(ByteBuffer view) {
    return new LightField(new Image[] {rgb(view)}, depth(ramp()));
  }

  private static Configuration configuration() {
    final Configuration made = new Configuration();
    made.width = WIDTH;
    made.height = HEIGHT;
    made.views = 1;
    made.disparityMin = -4;
    made.disparityMax = 4;
    return made;
  }

  /**
   * Returns a picture that is refocused in one call, and checks that the prepared light field gives
   * the same picture.
   */
  private static ByteBuffer refocused(
      LightField field, Consumer<Configuration> configure, Consumer<Parameters> choose) {
    final Configuration configuration = configuration();
    configure.accept(configuration);
    final Parameters parameters = new Parameters();
    parameters.focus = 1;
    choose.accept(parameters);
    final ByteBuffer once = bytes(3 * SIZE), prepared = bytes(3 * SIZE);
    try (Refocuser refocuser = new Refocuser(configuration)) {
      refocuser.refocus(field, parameters, rgb(once));
      refocuser.prepare(field);
      refocuser.refocusPrepared(parameters, rgb(prepared));
      check(refocuser.rowsDone() == HEIGHT, "rows done");
    }
    check(once.equals(prepared), "a prepared light field gives the same picture");
    return once;
  }

  private static ByteBuffer refocused(LightField field) {
    return refocused(field, configuration -> {}, parameters -> {});
  }

  private static ByteBuffer refocused(Consumer<Parameters> choose) {
    return refocused(field(), configuration -> configuration.shapes = 1, choose);
  }

  private static void parametersHaveTheirDefaultsAndMeaning() {
    final Configuration made = new Configuration();
    check(made.views == 5 && made.maxBlur == 32 && made.highlights == 1 && made.workers == 0,
        "defaults of the configuration");
    final Parameters defaults = new Parameters();
    check(defaults.shape == Parameters.SHAPE_FALL_OFF && defaults.blades == 5
            && defaults.ringInner == 0.5 && defaults.catsEye == 0 && defaults.focusNearer == 0
            && defaults.focusFarther == 0 && Math.abs(defaults.theta - 0.26 * Math.PI) < 1e-12
            && defaults.mode == Parameters.MODE_BLOCK && defaults.aperture == 1,
        "defaults of the parameters");
    final ByteBuffer plain = refocused(field());
    check(plain.equals(refocused(parameters -> {})), "shapes = 1 alone changes nothing");
    check(!plain.equals(refocused(p -> p.shape = Parameters.SHAPE_POLYGON)), "a pentagon");
    final ByteBuffer sharp =
        refocused(parameters -> parameters.focusNearer = parameters.focusFarther = 9);
    check(sharp.equals(refocused(p -> p.aperture = 0)), "if all is in focus, all is sharp");
    check(!sharp.equals(refocused(p -> p.focusNearer = 9)), "the far side ends at the focus");
  }

  private static void buffersHaveAnyPositionStrideAndRegion() {
    final ByteBuffer whole = refocused(field()), far = bytes(3 * SIZE + 40);
    far.position(33); // each plane begins at the position of its buffer
    far.put(picture(0)).position(33);
    final int stride = 3 * WIDTH + 10;
    final ByteBuffer wide = bytes(stride * HEIGHT), part = bytes(3 * 10 * 5);
    final Parameters parameters = new Parameters();
    parameters.focus = 1;
    try (Refocuser refocuser = new Refocuser(configuration())) {
      refocuser.prepare(fieldOf(far));
      refocuser.refocusPrepared(parameters, new Image(Image.RGB, wide, stride));
      parameters.regionX = 32;
      parameters.regionY = 20;
      parameters.regionWidth = 10;
      parameters.regionHeight = 5;
      refocuser.refocusPrepared(parameters, new Image(Image.RGB, part, 30));
    }
    boolean same = true;
    for (int i = 0; i < wide.capacity(); ++i) {
      final int x = i % stride, y = i / stride;
      same &= wide.get(i) == (x < 3 * WIDTH ? whole.get(3 * WIDTH * y + x) : 0);
    }
    check(same, "the picture is written between the bytes beside its rows");
    for (int i = 0; i < 150; ++i) {
      same &= part.get(i) == whole.get(3 * (WIDTH * (20 + i / 30) + 32) + i % 30);
    }
    check(same, "a region equals the same part of the picture");
  }

  /** Refocuses views with different bytes in the given order, at the given positions. */
  private static ByteBuffer refocusedFrom(int[] order, double[] positions) {
    final Image[] views = new Image[order.length];
    for (int k = 0; k < order.length; ++k) views[k] = rgb(picture(order[k]));
    return refocused(new LightField(views, depth(ramp())), configuration -> {
      configuration.views = order.length;
      configuration.positions = positions;
    }, parameters -> {});
  }

  private static void viewsLieWhereTheyAreSaidTo() {
    final int[] two = {0, 1};
    final ByteBuffer star = refocusedFrom(new int[] {0, 1, 2, 3, 4}, null);
    final double[] turned = {0, 0, -1, 0, 1, 0, 0, -1, 0, 1};
    check(star.equals(refocusedFrom(new int[] {0, 2, 1, 4, 3}, turned)), "a star in another order");
    final ByteBuffer pair = refocusedFrom(two, new double[] {0, 0, 1, 0});
    check(!pair.equals(star), "a pair gives another picture");
    check(!pair.equals(refocusedFrom(two, new double[] {0, 0, 0.5, 0})), "a nearer pair");
    checkThrows(OF_BUFFER, "positions: expected 4 numbers, found 3",
        () -> refocusedFrom(two, new double[] {0, 0, 1}));
    checkThrows(OF_LIBRARY, "positions[", () -> refocusedFrom(two, new double[] {0, 0, 1.5, 0}));
    checkThrows(OF_LIBRARY, "views: ", () -> refocusedFrom(two, null));
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
      checkThrows(
          OF_STATE, "no light field is prepared", () -> refocuser.preview(1, parameters, out));
      refocuser.prepare(field());
      refocuser.preview(1, parameters, out);
      checkThrows(OF_LIBRARY, "shift: ", () -> refocuser.preview(3, parameters, out));
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
    final ByteBuffer luma = bytes(SIZE), chroma = bytes(SIZE / 2), distances = bytes(2 * 40 * 30);
    for (int i = 0; i < SIZE; ++i) luma.put(i, (byte) 90);
    for (int i = 0; i < SIZE / 2; ++i) chroma.put(i, (byte) (i % 2 == 0 ? 120 : 135));
    for (int i = 0; i < 40 * 30; ++i) distances.putShort(2 * i, (short) (i % 2 * 500 | i << 13));
    final ByteBuffer v = chroma.duplicate();
    v.position(1);
    // In Android's layout, samples of U and V are two bytes apart, and the buffer of V starts one
    // byte after the buffer of U.
    final int[] strides = {WIDTH, WIDTH, WIDTH};
    final Image camera = new Image(Image.YUV_420_888, new ByteBuffer[] {luma, chroma, v}, strides);
    camera.pixelStride = 2;
    final ByteBuffer[] out = {bytes(SIZE), bytes(SIZE / 2)};
    final Image result = new Image(Image.NV12, out, new int[] {WIDTH, WIDTH});
    camera.range = result.range = Image.FULL;
    final DepthMap depth = new DepthMap(DepthMap.DEPTH16, distances, 80, 40, 30);
    depth.meaning = DepthMap.RECIPROCAL;
    depth.scale = 1000;
    final Configuration configuration = configuration();
    configuration.fillUnknown = 1;
    try (Refocuser refocuser = new Refocuser(configuration)) {
      refocuser.refocus(new LightField(new Image[] {camera}, depth), new Parameters(), result);
    }
    check(Math.abs(out[0].get(777) - 90) <= 1 && Math.abs(out[1].get(776) - 120) <= 1
            && Math.abs((out[1].get(777) & 255) - 135) <= 1,
        "a camera picture of one colour keeps the colour");
  }

  private static void wrongArgumentsAreRejected() {
    final int size = 3 * SIZE;
    final ByteBuffer late = picture(0), early = picture(0);
    late.position(1);
    early.limit(size - 1);
    final Parameters region = new Parameters(), blades = new Parameters(), eye = new Parameters(),
                     range = new Parameters(), plain = new Parameters();
    region.regionX = WIDTH;
    region.regionWidth = region.regionHeight = 1;
    blades.blades = 65536 + 5;
    eye.catsEye = 0.5;
    range.focusFarther = -1;
    final Image out = rgb(bytes(size));
    final String few = "view 0, plane 0: expected a buffer of";
    final Configuration wrong = configuration();
    wrong.views = 4;
    final Refocuser closed = new Refocuser(configuration());
    closed.close();
    closed.close();
    closed.cancel();
    check(closed.rowsDone() == 0, "rowsDone() is 0 after close()");
    checkThrows(OF_STATE, "closed", () -> closed.refocus(field(), plain, out));
    checkThrows(OF_STATE, "closed", () -> closed.largestAperture(plain));
    checkThrows(OF_LIBRARY, "views", () -> new Refocuser(wrong));
    checkThrows(OF_BUFFER, "direct", () -> rgb(ByteBuffer.allocate(size)));
    try (Refocuser refocuser = new Refocuser(configuration())) {
      final LightField good = field();
      checkThrows(OF_BUFFER, few, () -> refocuser.prepare(fieldOf(early)));
      checkThrows(
          NullPointerException.class, "parameters", () -> refocuser.refocus(good, null, out));
      final Object[][] rows = {
          {OF_LIBRARY, "region", good, region, out},
          {OF_LIBRARY, "blades: ", good, blades, out},
          {OF_LIBRARY, "cats_eye: ", good, eye, out},
          {OF_LIBRARY, "focus_farther: ", good, range, out},
          {OF_LIBRARY, "stride", good, plain, new Image(Image.RGB, bytes(size), 7)},
          {OF_BUFFER, "stride of 0 or more, found -1", good, plain,
              new Image(Image.RGB, bytes(size), -1)},
          {OF_BUFFER, "expected 2 planes, found 1", good, plain,
              new Image(Image.NV12, bytes(size), WIDTH)},
          {OF_BUFFER, "expected a buffer of 57600 bytes at least, found 57599", good, plain,
              rgb(bytes(size - 1))},
          {OF_BUFFER, "writable", good, plain, rgb(bytes(size).asReadOnlyBuffer())},
          {OF_BUFFER, few, fieldOf(bytes(size - 1)), plain, out},
          {OF_BUFFER, few, fieldOf(late), plain, out},
          {OF_BUFFER, "depth: expected a buffer of", field(depth(bytes(4 * SIZE - 1))), plain, out},
          {OF_BUFFER, "views: expected 1, found 0", new LightField(new Image[0], depth(ramp())),
              plain, out},
      };
      for (Object[] row : rows) {
        checkThrows((Class<?>) row[0], (String) row[1],
            () -> refocuser.refocus((LightField) row[2], (Parameters) row[3], (Image) row[4]));
      }
    }
  }

  /**
   * The last byte that a picture needs is the end of its last row. Buffers without this byte are
   * rejected, so that no call writes beyond a buffer.
   */
  private static void buffersMayEndAtTheLastByteOfThePicture() {
    final Configuration configuration = configuration();
    configuration.previews = 3;
    final int[][] rows = {
        // shift of the preview or 0, width and height of the region or 0, format, stride
        {0, 0, 0, Image.RGB, 3 * WIDTH},
        {0, 0, 0, Image.RGB, 3 * WIDTH + 7},
        {0, 0, 0, Image.RGBX, 4 * WIDTH},
        {0, 11, 1, Image.RGB, 999},
        {0, 11, 5, Image.RGB, 3 * 11},
        {0, 11, 5, Image.RGBX, 64},
        {2, 0, 0, Image.RGB, 120},
        {3, 9, 6, Image.RGB, 999},
    };
    try (Refocuser refocuser = new Refocuser(configuration)) {
      refocuser.prepare(field());
      for (int[] row : rows) {
        final Parameters parameters = new Parameters();
        parameters.regionWidth = row[1];
        parameters.regionHeight = row[2];
        final int width = (row[1] == 0 ? WIDTH : row[1]) + (1 << row[0]) - 1 >> row[0];
        final int height = (row[2] == 0 ? HEIGHT : row[2]) + (1 << row[0]) - 1 >> row[0];
        final int needed = row[4] * (height - 1) + (row[3] == Image.RGB ? 3 : 4) * width;
        final Consumer<Integer> refocus = size -> {
          final Image out = new Image(row[3], bytes(size), row[4]);
          if (row[0] == 0)
            refocuser.refocusPrepared(parameters, out);
          else
            refocuser.preview(row[0], parameters, out);
        };
        refocus.accept(needed);
        checkThrows(OF_BUFFER, "expected a buffer of " + needed + " bytes",
            () -> refocus.accept(needed - 1));
      }
      for (int odd : new int[] {1, -1, WIDTH + 1, 1 << 16, Integer.MAX_VALUE, Integer.MIN_VALUE}) {
        final Parameters parameters = new Parameters();
        parameters.regionWidth = odd;
        final Image out = rgb(bytes(3 * SIZE)), sparse = rgb(bytes(3 * SIZE));
        sparse.pixelStride = odd;
        checkThrows(RuntimeException.class, "", () -> refocuser.refocusPrepared(parameters, out));
        checkThrows(
            RuntimeException.class, "", () -> refocuser.refocusPrepared(new Parameters(), sparse));
      }
    }
  }

  private static void mapsOfDistancesAreMeasuredAndTapped() {
    final ByteBuffer distances = bytes(2 * 40 * 30); // 4000 in the left half, 500 in the right half
    for (int i = 0; i < 40 * 30; ++i) distances.putShort(2 * i, (short) (i % 40 < 20 ? 4000 : 500));
    distances.putShort(0, (short) 0);
    final DepthMap depth = new DepthMap(DepthMap.U16, distances, 80, 40, 30);
    depth.meaning = DepthMap.RECIPROCAL;
    depth.scale = 8000;
    depth.hasInvalid = 1;
    final double[] range = Refocuser.measureDisparity(depth);
    check(range.length == 2 && range[0] == 2 && range[1] == 16, "range of a map of distances");
    check(Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH / 2 - 1, 10) == 2, "focus at the left");
    check(Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH / 2, 10) == 16, "focus at the right half");
    check(Refocuser.focusAt(depth, WIDTH, HEIGHT, 0, 0) == 2, "focus at an unknown value");
    final String outside = "(expected inside the picture, found 160)";
    checkThrows(OF_LIBRARY, outside, () -> Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH, 10));
    checkThrows(OF_LIBRARY, "y: ", () -> Refocuser.focusAt(depth, WIDTH, HEIGHT, 10, -1));
    checkThrows(OF_LIBRARY, "width: ", () -> Refocuser.focusAt(depth, 39, 30, 5, 5));
    final Configuration configuration = configuration();
    configuration.disparityMin = 2;
    configuration.disparityMax = 16;
    configuration.maxBlur = 7;
    try (Refocuser refocuser = new Refocuser(configuration)) {
      final Parameters parameters = new Parameters();
      parameters.focus = 2;
      check(refocuser.largestAperture(parameters) == 0.5, "the largest aperture");
      parameters.focus = 1e9;
      checkThrows(OF_LIBRARY, "focus", () -> refocuser.largestAperture(parameters));
    }
    depth.scale = 0;
    checkThrows(OF_LIBRARY, "", () -> Refocuser.measureDisparity(depth));
  }

  /** Returns a copy of the rows of a map after `gap` bytes, `stride` bytes apart. */
  private static ByteBuffer rows(ByteBuffer map, int row, int stride, int gap) {
    final int height = map.capacity() / row, step = Math.abs(stride);
    final ByteBuffer copy = bytes(gap + step * height);
    for (int i = 0; i < map.capacity(); ++i) {
      final int y = i / row;
      copy.put(gap + step * (stride < 0 ? height - 1 - y : y) + i % row, map.get(i));
    }
    copy.position(gap);
    return copy;
  }

  private static void mapsOfAnyStrideAreRead() {
    final ByteBuffer floats = ramp(), codes = bytes(2 * SIZE);
    for (int i = 0; i < SIZE; ++i) {
      codes.putShort(2 * i, (short) Math.round((floats.getFloat(4 * i) + 4) * 64));
    }
    final ByteBuffer whole = refocused(field());
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
          final double focus = Refocuser.focusAt(depth(floats), WIDTH, HEIGHT, WIDTH - 1, 3);
          check(Refocuser.focusAt(depth, WIDTH, HEIGHT, WIDTH - 1, 3) == focus, what + ": focus");
          check(Refocuser.measureDisparity(depth)[1] == 159 * 8F / WIDTH - 4, what + ": range");
          check(whole.equals(refocused(field(depth))), what);
          final ByteBuffer made = refocused(field(small));
          check(ofCodes == null || made.equals(ofCodes), what + ": codes of 16 bits");
          ofCodes = made;
        }
      }
    }
    for (int stride : new int[] {-4 * WIDTH + 1, -4, -4 * WIDTH - 1, Integer.MIN_VALUE, 4}) {
      checkThrows(RuntimeException.class, "",
          ()
              -> Refocuser.measureDisparity(
                  new DepthMap(DepthMap.FLOAT, ramp(), stride, WIDTH, HEIGHT)));
    }
  }

  private static void coverageChangesThePicture() {
    final ByteBuffer map = ramp(), coverage = bytes(SIZE);
    for (int i = 0; i < SIZE; ++i) {
      map.putFloat(4 * i, i % WIDTH < WIDTH / 2 ? 4 : -4);
      coverage.put(i, (byte) Math.max(0, Math.min(255, 8 * (WIDTH / 2 + 16 - i % WIDTH))));
    }
    final java.util.function.BiFunction<ByteBuffer, Integer, LightField> covered = (buffer,
        stride) -> new LightField(new Image[] {rgb(picture(0))}, depth(map), buffer, stride);
    final ByteBuffer plain = refocused(field(depth(map)));
    check(plain.equals(refocused(covered.apply(null, 0))), "null is no coverage");
    final ByteBuffer made = refocused(covered.apply(coverage, WIDTH));
    check(!made.equals(plain), "coverage changes the picture");
    check(made.equals(refocused(covered.apply(rows(coverage, WIDTH, WIDTH + 7, 3), WIDTH + 7))),
        "coverage of any stride and position");
    checkThrows(OF_BUFFER, "coverage: expected a direct buffer",
        () -> covered.apply(ByteBuffer.allocate(SIZE), WIDTH));
    for (int stride : new int[] {WIDTH + 1, -WIDTH, Integer.MAX_VALUE}) {
      checkThrows(
          OF_BUFFER, "coverage: expected a ", () -> refocused(covered.apply(coverage, stride)));
    }
    checkThrows(OF_LIBRARY, "coverage", () -> refocused(covered.apply(coverage, WIDTH - 1)));
  }

  /** A map that had to be copied lives as long as its prepared light field. */
  private static void preparedCopiesStayAlive() {
    final int stride = -4 * WIDTH - 1;
    final Parameters parameters = new Parameters();
    final ByteBuffer first = bytes(3 * SIZE), later = bytes(3 * SIZE);
    try (Refocuser refocuser = new Refocuser(configuration())) {
      refocuser.prepare(field(
          new DepthMap(DepthMap.FLOAT, rows(ramp(), 4 * WIDTH, stride, 1), stride, WIDTH, HEIGHT)));
      refocuser.refocusPrepared(parameters, rgb(first));
      for (int round = 0; round < 5; ++round) {
        System.gc();
        refocuser.refocus(field(), parameters, rgb(later));
        refocuser.refocusPrepared(parameters, rgb(later));
        check(first.equals(later), "the prepared light field is unchanged by other calls");
      }
      final DepthMap short4 = new DepthMap(DepthMap.FLOAT, bytes(4), stride, WIDTH, HEIGHT);
      checkThrows(OF_BUFFER, "depth: expected a buffer", () -> refocuser.prepare(field(short4)));
      checkThrows(OF_STATE, "no light field is prepared",
          () -> refocuser.refocusPrepared(parameters, rgb(later)));
    }
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
          while (true) refocuser.refocus(field(), parameters, rgb(bytes(3 * SIZE)));
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
      final ByteBuffer pixels = bytes(3 * SIZE);
      refocuser.refocus(field(), parameters, rgb(pixels));
      check(pixels.equals(refocused(field())), "the call after a cancelled call gives the picture");
    }
  }

  public static void main(String[] arguments) throws InterruptedException {
    parametersHaveTheirDefaultsAndMeaning();
    buffersHaveAnyPositionStrideAndRegion();
    viewsLieWhereTheyAreSaidTo();
    aPreviewHasItsOwnSizeAndRegion();
    chromaOfACameraComesBack();
    wrongArgumentsAreRejected();
    buffersMayEndAtTheLastByteOfThePicture();
    mapsOfDistancesAreMeasuredAndTapped();
    mapsOfAnyStrideAreRead();
    coverageChangesThePicture();
    preparedCopiesStayAlive();
    anotherThreadCallsOff();
    if (failures == 0)
      System.out.println(checks + " checks");
    System.exit(failures == 0 ? 0 : 1);
  }
}

// SPDX-License-Identifier: Apache-2.0
import android.graphics.Bitmap;
import android.hardware.HardwareBuffer;
import dev.starfocus.Configuration;
import dev.starfocus.DepthMap;
import dev.starfocus.Image;
import dev.starfocus.LightField;
import dev.starfocus.Parameters;
import dev.starfocus.Refocuser;
import dev.starfocus.android.LockedBitmap;
import dev.starfocus.android.LockedHardwareBuffer;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;

/**
 * Tests the paths for Bitmap and HardwareBuffer. The only argument is the path of a library that
 * replaces Android's classes and the functions of the NDK. At aperture 0 the picture is the centre
 * view.
 */
public final class AndroidTest {
  private static final int WIDTH = 50, HEIGHT = 31;

  private static void check(boolean holds, String what) {
    if (!holds)
      throw new AssertionError(what);
  }

  private static void refocus(Image view, Image out) {
    final Configuration configuration = new Configuration();
    configuration.width = WIDTH;
    configuration.height = HEIGHT;
    configuration.views = 1;
    final ByteBuffer map =
        ByteBuffer.allocateDirect(4 * WIDTH * HEIGHT).order(ByteOrder.nativeOrder());
    final DepthMap depth = new DepthMap(DepthMap.FLOAT, map, 4 * WIDTH, WIDTH, HEIGHT);
    final Parameters parameters = new Parameters();
    parameters.aperture = 0;
    try (Refocuser refocuser = new Refocuser(configuration)) {
      refocuser.refocus(new LightField(new Image[] {view}, depth), parameters, out);
    }
  }

  private static void bitmaps() {
    final Bitmap from = new Bitmap(WIDTH, HEIGHT, 4 * WIDTH + 8, 1);
    final Bitmap to = new Bitmap(WIDTH, HEIGHT, 4 * WIDTH + 8, 1);
    for (int i = 0; i < from.pixels.capacity(); ++i) from.pixels.put(i, (byte) (i * i / 3));
    try (LockedBitmap view = new LockedBitmap(from); LockedBitmap out = new LockedBitmap(to)) {
      check(from.locks == 1 && to.locks == 1, "LockedBitmap locks the pixels");
      refocus(view.image, out.image);
    }
    check(from.locks == 0 && to.locks == 0, "LockedBitmap unlocks the pixels when it is closed");
    for (int y = 0; y < HEIGHT; ++y) {
      for (int i = 0; i < 4 * WIDTH + 8; ++i) {
        final int at = (4 * WIDTH + 8) * y + i;
        final int expected = i < 4 * WIDTH ? from.pixels.get(at) : 0;
        check(to.pixels.get(at) == expected, "byte " + at + " of the bitmap");
      }
    }
    try {
      new LockedBitmap(new Bitmap(WIDTH, HEIGHT, 2 * WIDTH, 4));
      check(false, "LockedBitmap rejects the format RGB_565");
    } catch (IllegalArgumentException error) {
      check(error.getMessage().contains("found the format 4"), error.getMessage());
    }
  }

  private static void hardwareBuffers() {
    final HardwareBuffer camera = new HardwareBuffer(WIDTH, HEIGHT, 0x23, 64, 2);
    final HardwareBuffer screen = new HardwareBuffer(WIDTH, HEIGHT, 1, 256, 4);
    for (int i = 0; i < camera.memory.capacity(); ++i) camera.memory.put(i, (byte) 128);
    for (int i = 0; i < 64 * HEIGHT; ++i) camera.memory.put(i, (byte) (i % 64 * 5));
    try (LockedHardwareBuffer view = new LockedHardwareBuffer(camera, false);
         LockedHardwareBuffer out = new LockedHardwareBuffer(screen, true)) {
      check(view.image.format == Image.YUV_420_888 && view.image.pixelStride == 2, "the format");
      refocus(view.image, out.image);
    }
    check(camera.locks == 0 && screen.locks == 0,
        "LockedHardwareBuffer unlocks the buffers when it is closed");
    // The picture is grey, so that R, G and B are equal to the luma.
    for (int i = 0; i < 4 * WIDTH; ++i) {
      final byte expected = i % 4 == 3 ? (byte) 255 : (byte) (i / 4 * 5);
      check(screen.memory.get(256 * (HEIGHT - 1) + i) == expected, "byte " + i + " of the screen");
    }
    try {
      new LockedHardwareBuffer(new HardwareBuffer(WIDTH, HEIGHT, 4, 128, 2), false);
      check(false, "LockedHardwareBuffer rejects the format RGB_565");
    } catch (IllegalArgumentException error) {
      check(error.getMessage().contains("of the format 4"), error.getMessage());
    }
  }

  public static void main(String[] arguments) {
    Refocuser.version();
    System.load(arguments[0]);
    bitmaps();
    hardwareBuffers();
    System.out.println("bitmaps and hardware buffers");
  }
}

// SPDX-License-Identifier: Apache-2.0
import dev.starfocus.Configuration;
import dev.starfocus.DepthMap;
import dev.starfocus.Image;
import dev.starfocus.LightField;
import dev.starfocus.Parameters;
import dev.starfocus.Refocuser;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Locale;
import javax.imageio.ImageIO;

/**
 * Usage: Refocus FOLDER FOCUS OUT.ppm. Refocuses a light field of five views, for example a folder
 * that `starfocus-lab scene --views 5` has written.
 */
public final class Refocus {
  private static final int VIEWS = 5;

  public static void main(String[] arguments) throws IOException {
    final Path folder = Path.of(arguments[0]);
    final Image[] views = new Image[VIEWS];
    int width = 0, height = 0;
    for (int i = 0; i < VIEWS; ++i) {
      final double[] place = Refocuser.viewPosition(i);
      final String name = String.format(Locale.ROOT, "view_%+.1f_%+.1f.png", place[0], place[1]);
      final BufferedImage picture = ImageIO.read(folder.resolve(name).toFile());
      width = picture.getWidth();
      height = picture.getHeight();
      views[i] = new Image(Image.RGB, pixelsOf(picture), 3 * width);
    }
    final ByteBuffer disparity = readPfm(folder.resolve("disparity.pfm"), width, height);
    final LightField field =
        new LightField(views, new DepthMap(DepthMap.FLOAT, disparity, 4 * width, width, height));

    final Configuration configuration = new Configuration();
    configuration.width = width;
    configuration.height = height;
    configuration.views = VIEWS;
    configuration.disparityMin = configuration.disparityMax = disparity.getFloat(0);
    for (int at = 0; at < disparity.capacity(); at += 4) {
      final float value = disparity.getFloat(at);
      configuration.disparityMin = Math.min(configuration.disparityMin, value);
      configuration.disparityMax = Math.max(configuration.disparityMax, value);
    }
    final Parameters parameters = new Parameters();
    parameters.focus = Double.parseDouble(arguments[1]);
    final ByteBuffer out = ByteBuffer.allocateDirect(3 * width * height);
    try (Refocuser refocuser = new Refocuser(configuration)) {
      refocuser.refocus(field, parameters, new Image(Image.RGB, out, 3 * width));
    }
    writePpm(Path.of(arguments[2]), out, width, height);
    System.out.println("starfocus " + Refocuser.version());
  }

  private static ByteBuffer pixelsOf(BufferedImage picture) {
    final int width = picture.getWidth(), height = picture.getHeight();
    final int[] row = new int[width];
    final ByteBuffer pixels = ByteBuffer.allocateDirect(3 * width * height);
    for (int y = 0; y < height; ++y) {
      picture.getRGB(0, y, width, 1, row, 0, width);
      for (int pixel : row) {
        pixels.put((byte) (pixel >> 16)).put((byte) (pixel >> 8)).put((byte) pixel);
      }
    }
    pixels.flip();
    return pixels;
  }

  /**
   * Reads a PFM file. A PFM header has three lines. Rows are stored from bottom to top. The sign of
   * the scale in the header gives the byte order (negative: little endian).
   */
  private static ByteBuffer readPfm(Path path, int width, int height) throws IOException {
    final byte[] bytes = Files.readAllBytes(path);
    final int first = bytes.length - 4 * width * height;
    final boolean little = new String(bytes, 0, first, StandardCharsets.US_ASCII).contains("-");
    final ByteBuffer rows =
        ByteBuffer.wrap(bytes).order(little ? ByteOrder.LITTLE_ENDIAN : ByteOrder.BIG_ENDIAN);
    final ByteBuffer map =
        ByteBuffer.allocateDirect(4 * width * height).order(ByteOrder.nativeOrder());
    for (int y = height - 1; y >= 0; --y) {
      for (int x = 0; x < width; ++x) map.putFloat(rows.getFloat(first + 4 * (y * width + x)));
    }
    map.flip();
    return map;
  }

  private static void writePpm(Path path, ByteBuffer pixels, int width, int height)
      throws IOException {
    final byte[] bytes = new byte[pixels.capacity()];
    pixels.get(bytes);
    try (OutputStream file = Files.newOutputStream(path)) {
      file.write(("P6\n" + width + " " + height + "\n255\n").getBytes(StandardCharsets.US_ASCII));
      file.write(bytes);
    }
  }
}

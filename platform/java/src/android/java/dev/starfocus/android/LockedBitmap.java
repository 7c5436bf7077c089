// SPDX-License-Identifier: Apache-2.0
package dev.starfocus.android;

import android.graphics.Bitmap;
import dev.starfocus.Image;
import dev.starfocus.Refocuser;
import java.nio.ByteBuffer;

/**
 * The pixels of a Bitmap of ARGB_8888 where they are, as an {@link Image} of R, G, B and alpha, to
 * be read or written until it is closed. Colours are taken as they are stored: those of transparent
 * pixels are multiplied by alpha.
 */
public final class LockedBitmap implements AutoCloseable {
  static {
    Refocuser.version(); // loads the library
  }

  public final Image image;
  private Bitmap bitmap;

  public LockedBitmap(Bitmap bitmap) {
    final int[] stride = new int[1];
    image = new Image(Image.RGBX, lock(bitmap, stride), stride[0]);
    this.bitmap = bitmap;
  }

  /** Gives the pixels back; the image must not be used any more. */
  @Override
  public void close() {
    if (bitmap != null)
      unlock(bitmap);
    bitmap = null;
  }

  private static native ByteBuffer lock(Bitmap bitmap, int[] stride);

  private static native void unlock(Bitmap bitmap);
}

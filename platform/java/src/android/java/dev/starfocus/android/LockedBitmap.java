// SPDX-License-Identifier: Apache-2.0
package dev.starfocus.android;

import android.graphics.Bitmap;
import dev.starfocus.Image;
import dev.starfocus.Refocuser;
import java.nio.ByteBuffer;

/**
 * Locks the pixels of an ARGB_8888 Bitmap until this object is closed. The field {@link #image}, of
 * format RGBX, refers to the locked pixels and may be read and written. Like the Bitmap, the image
 * stores colours of transparent pixels multiplied by alpha.
 */
public final class LockedBitmap implements AutoCloseable {
  static {
    Refocuser.version(); // loads the library
  }

  /** The locked pixels, which must not be used after {@link #close}. */
  public final Image image;
  private Bitmap bitmap;

  /**
   * Locks the pixels of a bitmap.
   *
   * @throws IllegalArgumentException if the bitmap is null, not ARGB_8888, or cannot be locked
   */
  public LockedBitmap(Bitmap bitmap) {
    final int[] stride = new int[1];
    image = new Image(Image.RGBX, lock(bitmap, stride), stride[0]);
    this.bitmap = bitmap;
  }

  /** Unlocks the pixels. No-op if the bitmap is already unlocked. */
  @Override
  public void close() {
    if (bitmap != null)
      unlock(bitmap);
    bitmap = null;
  }

  /** Locks the pixels. {@code stride[0]} receives the distance between rows in bytes. */
  private static native ByteBuffer lock(Bitmap bitmap, int[] stride);

  private static native void unlock(Bitmap bitmap);
}

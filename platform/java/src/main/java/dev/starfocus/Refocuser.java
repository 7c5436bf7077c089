// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.io.Closeable;
import java.util.Objects;

/**
 * An engine for light fields of one configuration. A Refocuser allocates native memory in its
 * constructor and in the first call of {@link #prepare}. {@link #close} frees this memory. Several
 * threads may use a Refocuser, but only one call runs at a time. {@link #cancel} and {@link
 * #rowsDone} do not wait for a running call, so that other threads can use them during a call.
 *
 * <p>Calls throw {@link StarfocusException} for errors that the library reports, such as values or
 * disparities out of range. Calls throw IllegalArgumentException for buffers that are not direct or
 * are too small, and for read-only outputs. Calls throw NullPointerException for null arguments,
 * OutOfMemoryError if memory is insufficient, and IllegalStateException after {@link #close}.
 *
 * <p>The bytes of pictures depend neither on the machine nor on the number of workers.
 */
public final class Refocuser implements Closeable {
  /**
   * Prevents {@link #close} from freeing the session while {@link #cancel} or {@link #rowsDone}
   * uses it.
   */
  private final Object life = new Object();

  private long session;
  /** Keeps alive the buffers that {@link #refocusPrepared} reads. */
  private LightField prepared;

  /**
   * Creates an engine and its threads.
   *
   * @param configuration configuration, which the Refocuser copies
   */
  public Refocuser(Configuration configuration) {
    session = Native.create(Objects.requireNonNull(configuration, "configuration"));
  }

  /**
   * Refocuses a light field.
   *
   * @param field light field, which the engine reads only during the call and does not change
   * @param parameters lens and region
   * @param out receives the picture, in any format. The image has the size of the picture, or of
   *     the region of the parameters, and must not overlap the light field. Alpha is copied from
   *     the centre view, or is 255 if the centre view has no alpha. After {@link #cancel}, the
   *     contents of the image are unspecified
   */
  public synchronized void refocus(LightField field, Parameters parameters, Image out) {
    Objects.requireNonNull(parameters, "parameters");
    out.checkWritable();
    Native.refocus(open(), Objects.requireNonNull(field, "field"), parameters, out);
  }

  /**
   * Prepares a light field: computes the data that do not depend on the lens, for later calls of
   * {@link #refocusPrepared}. Discards the previously prepared light field, even if the call fails.
   *
   * @param field light field. The contents of its buffers must not change until another light field
   *     is prepared or the Refocuser is closed
   */
  public synchronized void prepare(LightField field) {
    prepared = null;
    Native.prepare(open(), Objects.requireNonNull(field, "field"));
    prepared = field;
  }

  /**
   * Refocuses the prepared light field. The output has the same bytes as the output of {@link
   * #refocus} for the prepared light field.
   *
   * @param parameters lens and region
   * @param out receives the picture, as for {@link #refocus}
   * @throws IllegalStateException if no light field is prepared
   */
  public synchronized void refocusPrepared(Parameters parameters, Image out) {
    checkPrepared(parameters, out);
    Native.refocusPrepared(open(), 0, parameters, out);
  }

  /**
   * Refocuses the prepared light field at 1 / 2^shift of the full size, in about 1 / 4^shift of the
   * time of a full picture.
   *
   * @param shift 1 to {@link Configuration#previews}; 0 is the full size
   * @param parameters lens and region, in pixels of the full size
   * @param out receives the picture. The picture contains all reduced pixels that overlap the
   *     region; a whole picture has a size of ceil(width / 2^shift) times ceil(height / 2^shift).
   *     Alpha is 255
   * @throws IllegalStateException if no light field is prepared
   */
  public synchronized void preview(int shift, Parameters parameters, Image out) {
    checkPrepared(parameters, out);
    Native.refocusPrepared(open(), shift, parameters, out);
  }

  /**
   * Cancels the call that is running on another thread. The cancelled call ends within milliseconds
   * and throws a StarfocusException for which {@link StarfocusException#isCancelled} is true. No-op
   * if no call is running.
   */
  public void cancel() {
    synchronized (life) {
      if (session != 0)
        Native.cancel(session);
    }
  }

  /**
   * Returns the progress of the running call, or of the last call if no call is running.
   *
   * @return number of finished rows; 0 after {@link #close}
   */
  public int rowsDone() {
    synchronized (life) {
      return session == 0 ? 0 : Native.rowsDone(session);
    }
  }

  /**
   * Waits for a running call, ends the threads and frees the native memory. No-op if the Refocuser
   * is already closed.
   */
  @Override
  public synchronized void close() {
    final long ended;
    synchronized (life) {
      ended = session;
      session = 0;
    }
    prepared = null;
    if (ended != 0)
      Native.destroy(ended);
  }

  /**
   * Returns the focus for the surface at a pixel, for example at the pixel that a user tapped. The
   * focus is the median of the disparities of the surface, up to 3 values of the map away from the
   * pixel. Does not wait for calls of a Refocuser.
   *
   * @param depth map of any format
   * @param width width of the picture in pixels, 1 to 65535
   * @param height height of the picture in pixels, 1 to 65535
   * @param x column of the picture, 0 to width - 1
   * @param y row of the picture, 0 to height - 1
   * @return the disparity to focus at
   * @throws StarfocusException if the pixel lies outside the picture, or all disparities up to 3
   *     values away are unknown
   */
  public static double focusAt(DepthMap depth, int width, int height, int x, int y) {
    return Native.focusAt(depth, new int[] {width, height, x, y});
  }

  /**
   * Returns the largest aperture, at most 1, whose blur radius never exceeds {@link
   * Configuration#maxBlur}.
   *
   * @param parameters lens, of which the aperture is ignored
   * @throws StarfocusException if the focus is out of range
   */
  public synchronized double largestAperture(Parameters parameters) {
    return Native.largestAperture(open(), Objects.requireNonNull(parameters, "parameters"));
  }

  /**
   * Measures the range of the disparities of a depth map, for {@link Configuration#disparityMin}
   * and {@link Configuration#disparityMax}.
   *
   * @param depth map of any format
   * @return an array of the smallest and the largest known disparity; 0 and 0 if no disparity is
   *     known
   */
  public static double[] measureDisparity(DepthMap depth) {
    return Native.measureDisparity(depth);
  }

  /**
   * Returns the position of a view in the star, the default arrangement of views: 0 is the centre;
   * 1 to 4 are (1, 0), (-1, 0), (0, 1), (0, -1); 5 to 8 are (1, 1), (-1, 1), (1, -1), (-1, -1); 9
   * to 16 are views 1 to 8 at half the distance. u grows to the right, and v downwards.
   *
   * @param index index of the view, 0 to 16
   * @return an array of u and v
   * @throws StarfocusException if the index is out of range
   */
  public static double[] viewPosition(int index) {
    return Native.viewPosition(index);
  }

  /**
   * Returns the version of the library and the SIMD target that the library uses on this machine.
   *
   * @return a text, for example "0.1.0, NEON"
   */
  public static String version() {
    return Native.version();
  }

  private void checkPrepared(Parameters parameters, Image out) {
    if (prepared == null)
      throw new IllegalStateException("Refocuser: no light field is prepared");
    Objects.requireNonNull(parameters, "parameters");
    out.checkWritable();
  }

  private long open() {
    if (session == 0)
      throw new IllegalStateException("Refocuser: it has been closed");
    return session;
  }
}

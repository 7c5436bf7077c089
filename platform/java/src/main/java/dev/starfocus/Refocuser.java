// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.util.Objects;

/**
 * An engine for light fields of one configuration. It takes memory when it is made and when a light
 * field is prepared, and gives it back in {@link #close}. Calls of several threads take turns;
 * {@link #cancel} and {@link #rowsDone} are for other threads than the one that refocuses.
 *
 * <p>What is wrong is told by StarfocusException, and by IllegalArgumentException for buffers that
 * are not direct or smaller than what is in them. Bytes of pictures depend neither on the machine
 * nor on the number of workers.
 */
public final class Refocuser implements AutoCloseable {
  /** Guards the session against its end while another thread asks or cancels. */
  private final Object life = new Object();

  private long session;
  /** Its buffers are read by {@link #refocusPrepared}. */
  private LightField prepared;

  public Refocuser(Configuration configuration) {
    session = Native.create(Objects.requireNonNull(configuration, "configuration"));
  }

  /** Refocuses into `out`, which is as large as the picture or the parameters' region. */
  public synchronized void refocus(LightField field, Parameters parameters, Image out) {
    Objects.requireNonNull(parameters, "parameters");
    out.checkWritable();
    Native.refocus(open(), Objects.requireNonNull(field, "field"), parameters, out);
  }

  /** Does once what is the same for every lens; what the light field's buffers hold must stay. */
  public synchronized void prepare(LightField field) {
    prepared = null;
    Native.prepare(open(), Objects.requireNonNull(field, "field"));
    prepared = field;
  }

  /** As {@link #refocus} of the light field that was prepared last, with the same bytes. */
  public synchronized void refocusPrepared(Parameters parameters, Image out) {
    checkPrepared(parameters, out);
    Native.refocusPrepared(open(), parameters, out);
  }

  /**
   * As {@link #refocusPrepared} at 1 / 2^shift of the size, from 1 to the previews of the
   * configuration. Focus and region are in pixels of the full size; `out` has the pixels that have
   * a part of the region, of a whole picture ceil(width / 2^shift) times ceil(height / 2^shift).
   */
  public synchronized void preview(int shift, Parameters parameters, Image out) {
    checkPrepared(parameters, out);
    Native.preview(open(), shift, parameters, out);
  }

  /**
   * Ends the call that another thread is in, within milliseconds, by a StarfocusException that is
   * cancelled. Without such a call nothing happens.
   */
  public void cancel() {
    synchronized (life) {
      if (session != 0)
        Native.cancel(session);
    }
  }

  /** Rows that the call has made which another thread is in, or that the last one made. */
  public int rowsDone() {
    synchronized (life) {
      return session == 0 ? 0 : Native.rowsDone(session);
    }
  }

  /** Gives the memory back, once no call is running; closing again does nothing. */
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

  /** The focus for what is at a pixel of a map of FLOAT and LINEAR disparities, such as a tap. */
  public static double focusAt(DepthMap disparity, int x, int y) {
    return Native.focusAt(disparity, x, y);
  }

  /** Where captured view `index` lies: u and v. */
  public static double[] viewPosition(int index) {
    return Native.viewPosition(index);
  }

  /** The library's version and the SIMD instructions it uses here, such as "0.1.0, NEON". */
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

// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/**
 * Native methods of {@link Refocuser}. Refocuser documents the corresponding public methods. A
 * session is the address of a native structure that owns an engine, its threads and the prepared
 * light field. {@link #create} returns a session, and {@link #destroy} frees the session.
 */
final class Native {
  static {
    System.loadLibrary("starfocus_jni");
  }

  private Native() {}

  static native void initialize(Configuration configuration);

  static native void initialize(Parameters parameters);

  static native long create(Configuration configuration);

  static native void destroy(long session);

  static native void refocus(long session, LightField lightField, Parameters parameters, Image out);

  static native void prepare(long session, LightField lightField);

  /** {@code shift} is 0 for the full size. */
  static native void refocusPrepared(long session, int shift, Parameters parameters, Image out);

  static native void cancel(long session);

  static native int rowsDone(long session);

  /** {@code place} is the width and height of the picture, and x and y of the pixel. */
  static native double focusAt(DepthMap depth, int[] place);

  static native double largestAperture(long session, Parameters parameters);

  static native double[] measureDisparity(DepthMap depth);

  static native double[] viewPosition(int index);

  static native String version();
}

// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/** Checks that buffers are direct, as the native library requires. */
final class DirectBuffers {
  private DirectBuffers() {}

  /**
   * Returns the part of a direct buffer from its position to its limit, without copying.
   *
   * @param what name of the argument in error messages
   * @throws IllegalArgumentException if the buffer is not direct
   */
  static ByteBuffer from(ByteBuffer buffer, String what) {
    if (!buffer.isDirect()) {
      throw new IllegalArgumentException(
          what + ": expected a direct buffer (ByteBuffer.allocateDirect)");
    }
    return buffer.slice();
  }
}

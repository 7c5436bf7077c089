// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

import java.nio.ByteBuffer;

/** Buffers as the library sees them. */
final class DirectBuffers {
  private DirectBuffers() {}

  /** The part from the position to the limit, nothing copied. */
  static ByteBuffer from(ByteBuffer buffer, String what) {
    if (!buffer.isDirect()) {
      throw new IllegalArgumentException(
          what + ": expected a direct buffer (ByteBuffer.allocateDirect)");
    }
    return buffer.slice();
  }
}

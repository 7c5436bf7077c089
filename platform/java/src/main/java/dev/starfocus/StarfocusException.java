// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/** The library refused a call; the message says why. */
public class StarfocusException extends RuntimeException {
  public static final int ERROR_CANCELLED = 17;

  private static final long serialVersionUID = 1;

  private final int status;

  StarfocusException(int status, String message) {
    super(message);
    this.status = status;
  }

  /** The starfocus_status of status.h. */
  public int status() {
    return status;
  }

  /** Whether {@link Refocuser#cancel} ended the call; what it was to write is unspecified then. */
  public boolean isCancelled() {
    return status == ERROR_CANCELLED;
  }
}

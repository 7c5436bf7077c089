// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/** An error that the library reports. The message names the cause. */
public class StarfocusException extends RuntimeException {
  /** {@link #status} of a call that {@link Refocuser#cancel} cancelled. */
  public static final int ERROR_CANCELLED = 17;

  private static final long serialVersionUID = 1;

  private final int status;

  StarfocusException(int status, String message) {
    super(message);
    this.status = status;
  }

  /**
   * Returns the status of the C call.
   *
   * @return a starfocus_status; starfocus/status.h lists the values
   */
  public int status() {
    return status;
  }

  /**
   * Returns whether the call was cancelled. The output of a cancelled call is unspecified.
   *
   * @return true if {@link Refocuser#cancel} cancelled the call
   */
  public boolean isCancelled() {
    return status == ERROR_CANCELLED;
  }
}

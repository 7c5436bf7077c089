// SPDX-License-Identifier: Apache-2.0
package dev.starfocus;

/** An error that the library reports. The message of the exception names the cause. */
public class StarfocusException extends RuntimeException {
  /** Value of {@link #status} after {@link Refocuser#cancel} has cancelled the call. */
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
   * @return a value of starfocus_status, which starfocus/starfocus.h defines
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

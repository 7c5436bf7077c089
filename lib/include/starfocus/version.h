/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Version of starfocus with which a program is compiled. starfocus_version() returns the version
 * of the library with which the program runs. The build reads the three numbers of the version
 * from this file. */
#ifndef STARFOCUS_VERSION_H_
#define STARFOCUS_VERSION_H_

/** Number of the ABI, which grows when a public structure or the meaning of a function changes. The
 *  build takes the version of the shared library and of its symbols from this line. */
#define STARFOCUS_ABI 1
/** First number of the version. */
#define STARFOCUS_VERSION_MAJOR 0
/** Second number of the version. */
#define STARFOCUS_VERSION_MINOR 1
/** Third number of the version. */
#define STARFOCUS_VERSION_PATCH 0

#define STARFOCUS_VERSION_TEXT_(major, minor, patch) #major "." #minor "." #patch
#define STARFOCUS_VERSION_TEXT(major, minor, patch) STARFOCUS_VERSION_TEXT_(major, minor, patch)
/** Version as a string, for example "0.1.0". */
#define STARFOCUS_VERSION_STRING \
  STARFOCUS_VERSION_TEXT(STARFOCUS_VERSION_MAJOR, STARFOCUS_VERSION_MINOR, STARFOCUS_VERSION_PATCH)

#endif /* STARFOCUS_VERSION_H_ */

/* SPDX-License-Identifier: Apache-2.0 */
/* The version of starfocus that a program is compiled with; starfocus_version() tells the one it
 * runs with. These three numbers are the only place that holds it: the build reads them here. */
#ifndef STARFOCUS_VERSION_H_
#define STARFOCUS_VERSION_H_

#define STARFOCUS_VERSION_MAJOR 0
#define STARFOCUS_VERSION_MINOR 1
#define STARFOCUS_VERSION_PATCH 0

#define STARFOCUS_VERSION_TEXT_(major, minor, patch) #major "." #minor "." #patch
#define STARFOCUS_VERSION_TEXT(major, minor, patch) STARFOCUS_VERSION_TEXT_(major, minor, patch)
/** The three of them with dots between. */
#define STARFOCUS_VERSION_STRING \
  STARFOCUS_VERSION_TEXT(STARFOCUS_VERSION_MAJOR, STARFOCUS_VERSION_MINOR, STARFOCUS_VERSION_PATCH)

#endif /* STARFOCUS_VERSION_H_ */

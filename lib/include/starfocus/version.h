/* SPDX-License-Identifier: Apache-2.0 */
/* The version of starfocus that a program is compiled with; sf_version() tells the one it runs
 * with. These three numbers are the only place that holds it: the build reads them here. */
#ifndef STARFOCUS_VERSION_H_
#define STARFOCUS_VERSION_H_

#define SF_VERSION_MAJOR 0
#define SF_VERSION_MINOR 1
#define SF_VERSION_PATCH 0

#define SF_VERSION_TEXT_(major, minor, patch) #major "." #minor "." #patch
#define SF_VERSION_TEXT(major, minor, patch) SF_VERSION_TEXT_(major, minor, patch)
/** The three of them with dots between. */
#define SF_VERSION_STRING SF_VERSION_TEXT(SF_VERSION_MAJOR, SF_VERSION_MINOR, SF_VERSION_PATCH)

#endif /* STARFOCUS_VERSION_H_ */

/* SPDX-License-Identifier: Apache-2.0 */
/* Headers of the Swift module CStarfocus. The module does not include the thread pool, because a
 * starfocus_runner in Swift can use DispatchQueue.concurrentPerform. */
#include <starfocus/depth.h>
#include <starfocus/matte.h>
#include <starfocus/starfocus.h>
#include <starfocus/video.h>

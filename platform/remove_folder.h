// SPDX-License-Identifier: Apache-2.0
// Removes folders in signal handlers.
#ifndef STARFOCUS_PLATFORM_REMOVE_FOLDER_H_
#define STARFOCUS_PLATFORM_REMOVE_FOLDER_H_

namespace starfocus {

// Removes the folder `path` with everything in it, and does not follow links. Stops when nothing
// more can be removed. The function is safe in a signal handler: it allocates no memory and takes
// no locks, and on Linux it starts no program, because programs give up this right.
void RemoveFolder(const char* path);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_REMOVE_FOLDER_H_

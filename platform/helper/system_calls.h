// SPDX-License-Identifier: Apache-2.0
// Restricts the system calls of a helper process.
#ifndef STARFOCUS_PLATFORM_HELPER_SYSTEM_CALLS_H_
#define STARFOCUS_PLATFORM_HELPER_SYSTEM_CALLS_H_

namespace starfocus {

// Permits only system calls that decoders need: for memory, for threads of the calling process, for
// the clock, and for reading and writing files that are already open. All other system calls of
// this process fail from now on. Returns false if the kernel does not support such filters.
bool RestrictSystemCalls();

// Forbids this process the system calls that connect to networks, start programs, access other
// processes, or have often been used to attack the kernel. Returns false if the kernel does not
// support such filters.
bool ForbidSystemCalls();

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_HELPER_SYSTEM_CALLS_H_

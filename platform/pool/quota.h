// SPDX-License-Identifier: Apache-2.0
// Finds how many cores the control groups (cgroups) of Linux allow this process to use, for example
// in a container that was started with `docker run --cpus 2`. Used by the thread pool (pool.cc).
#ifndef STARFOCUS_PLATFORM_POOL_QUOTA_H_
#define STARFOCUS_PLATFORM_POOL_QUOTA_H_

namespace starfocus {

// Returns the least quota of processor time of the control groups that the file `groups` lists, and
// of their parents, in cores and rounded up. Returns 0 if no quota is set. Reads the files cpu.max
// (version 2) or cpu.cfs_quota_us and cpu.cfs_period_us (version 1) in the folder `mounted`.
// `groups` is /proc/self/cgroup and `mounted` is /sys/fs/cgroup, except in tests.
int QuotaCores(const char* groups, const char* mounted);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_POOL_QUOTA_H_

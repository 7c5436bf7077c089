// SPDX-License-Identifier: Apache-2.0
#include "platform/helper/system_calls.h"

#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>

namespace starfocus {
namespace {

// System calls that are permitted with any arguments. A name that an architecture does not have is
// ignored there.
constexpr int kPermitted[] = {
    // files that are open
    SCMP_SYS(read), SCMP_SYS(write), SCMP_SYS(readv), SCMP_SYS(writev), SCMP_SYS(close),
    SCMP_SYS(fstat), SCMP_SYS(lseek), SCMP_SYS(vmsplice),
    // memory
    SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise),
    // threads and signals of this process
    SCMP_SYS(futex), SCMP_SYS(futex_time64), SCMP_SYS(set_robust_list), SCMP_SYS(rseq),
    SCMP_SYS(gettid), SCMP_SYS(getpid), SCMP_SYS(sched_yield), SCMP_SYS(sched_getaffinity),
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigreturn),
    SCMP_SYS(sigaltstack), SCMP_SYS(restart_syscall), SCMP_SYS(exit), SCMP_SYS(exit_group),
    // clock and random numbers
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_gettime64), SCMP_SYS(gettimeofday),
    SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep), SCMP_SYS(getrandom)};

// System calls that a program which starts no other program does not need.
constexpr int kForbidden[] = {
    // networks
    SCMP_SYS(socket), SCMP_SYS(socketpair), SCMP_SYS(socketcall), SCMP_SYS(io_uring_setup),
    // programs
    SCMP_SYS(execve), SCMP_SYS(execveat),
    // other processes
    SCMP_SYS(ptrace), SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev),
    SCMP_SYS(pidfd_getfd),
    // the kernel
    SCMP_SYS(bpf), SCMP_SYS(keyctl), SCMP_SYS(perf_event_open), SCMP_SYS(unshare),
    SCMP_SYS(userfaultfd)};

// Loads a filter for this process and its later threads, and frees the filter.
bool Load(scmp_filter_ctx filter) {
  // Older kernels otherwise slow down processes that have a filter (speculative store bypass).
  seccomp_attr_set(filter, SCMP_FLTATR_CTL_SSB, 1);
  const int failure = seccomp_load(filter);
  seccomp_release(filter);
  return failure == 0;
}

void Permit(scmp_filter_ctx filter, int call, const scmp_arg_cmp& condition) {
  seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, call, 1, &condition);
}

// Permits system calls only with certain arguments.
void PermitPartly(scmp_filter_ctx filter) {
  // New threads, but no new processes.
  Permit(filter, SCMP_SYS(clone), SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, CLONE_THREAD));
  // The filter cannot read the arguments of clone3. With ENOSYS, the C library calls clone instead.
  seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0, nullptr);
  // The program's code is mapped already, so no other memory is executable.
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mmap2), SCMP_SYS(mprotect)}) {
    Permit(filter, call, SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0));
  }
  // abort() sends a signal to its own thread.
  Permit(filter, SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid())));
}

}  // namespace

bool RestrictSystemCalls() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (filter == nullptr) return false;
  for (const int call : kPermitted) {
    seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, call, 0, nullptr);
  }
  PermitPartly(filter);
  return Load(filter);
}

bool ForbidSystemCalls() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ALLOW);
  if (filter == nullptr) return false;
  for (const int call : kForbidden) {
    seccomp_rule_add_array(filter, SCMP_ACT_ERRNO(EPERM), call, 0, nullptr);
  }
  return Load(filter);
}

}  // namespace starfocus

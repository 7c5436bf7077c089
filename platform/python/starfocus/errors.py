# SPDX-License-Identifier: Apache-2.0
"""What the functions of the package raise, beside TypeError and ValueError for arrays of a wrong kind or shape."""
from __future__ import annotations

import math
from typing import Optional

from ._abi import Problem, library
from .constants import Status


class StarfocusError(Exception):
    """The library refused a call. `status` says why as a number, the text as a sentence. `field` is what was
    refused, a field of a structure or an argument; "" if it is no single one."""

    def __init__(self, status: int, problem: Optional[Problem] = None):
        text = library.starfocus_status_string(status).decode()
        self.field = ""
        if problem is not None and problem.status == status and problem.field:
            self.field = problem.field.decode().replace("[]", f"[{problem.index}]")
            found = "" if math.isnan(problem.value) else f", found {problem.value:.9g}"
            text = f"{self.field}: {text} (expected {problem.expected.decode()}{found})"
        super().__init__(text)
        self.status = Status(status)


class ArgumentError(StarfocusError, ValueError):
    """A field of the configuration or an argument is outside its range."""


class DisparityError(ArgumentError):
    """A disparity map holds values that are not finite or outside of the configured range."""


class OutOfMemory(StarfocusError, MemoryError):
    """There is not as much memory as the library needs."""


class Cancelled(StarfocusError):
    """The caller's progress function said so; what was to be written is unspecified."""


_KINDS = {
    Status.NOT_FINITE: DisparityError,
    Status.DISPARITY: DisparityError,
    Status.ALL_INVALID: DisparityError,
    Status.MEMORY: OutOfMemory,
    Status.TOO_LARGE: OutOfMemory,
    Status.CANCELLED: Cancelled,
    Status.RUNNER: StarfocusError,
}


def check(status: int, problem: Optional[Problem] = None) -> None:
    """Raises the error that a status stands for, if it is one."""
    if status != Status.OK:
        raise _KINDS.get(Status(status), ArgumentError)(status, problem)

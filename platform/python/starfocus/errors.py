# SPDX-License-Identifier: Apache-2.0
"""Exceptions of the package. Arrays of a wrong type or shape raise TypeError or ValueError instead."""
from __future__ import annotations

import math
from ctypes import Structure, byref
from typing import Any, Optional

from ._abi import Problem, library
from .constants import Status


class StarfocusError(Exception):
    """The library reported an error. The message is a sentence with the cause.

    Attributes:
        status: the `Status` of the C call.
        field: name of the wrong field or argument; "" if no single one is wrong.
    """

    def __init__(self, status: int, problem: Optional[Structure] = None):
        text = library.starfocus_status_string(status).decode()
        self.field = ""
        if problem is not None and problem.status == status and problem.field:
            self.field = problem.field.decode().replace("[]", f"[{problem.index}]")
            found = "" if math.isnan(problem.value) else f", found {problem.value:.9g}"
            if status in (Status.NOT_FINITE, Status.DISPARITY) and problem.x >= 0:
                found += f" at ({problem.x}, {problem.y})"
            text = f"{self.field}: {text} (expected {problem.expected.decode()}{found})"
        super().__init__(text)
        self.status = Status(status)


class ArgumentError(StarfocusError, ValueError):
    """A field of the configuration or an argument is outside its range."""


class DisparityError(ArgumentError):
    """A disparity map contains values that are not finite or outside the configured range."""


class OutOfMemory(StarfocusError, MemoryError):
    """The library needs more memory than is available."""


class Cancelled(StarfocusError):
    """The progress function cancelled the call. The contents of the output are unspecified."""


_KINDS = {
    Status.NOT_FINITE: DisparityError,
    Status.DISPARITY: DisparityError,
    Status.ALL_INVALID: DisparityError,
    Status.MEMORY: OutOfMemory,
    Status.TOO_LARGE: OutOfMemory,
    Status.CANCELLED: Cancelled,
    Status.RUNNER: StarfocusError,
}


def out_of_range(field: str, expected: str, found: float) -> ArgumentError:
    """Returns the error for an argument that the package checks itself."""
    return ArgumentError(Status.RANGE, Problem(Status.RANGE, 0, field.encode(), expected.encode(), found))


def check(status: int, problem: Optional[Structure] = None) -> None:
    """Raises the exception for a status, unless it is OK."""
    if status != Status.OK:
        raise _KINDS.get(Status(status), ArgumentError)(status, problem)


def call(function: Any, *arguments: Any) -> None:
    """Calls a function whose last argument is a starfocus_problem. Raises the exception for its status."""
    problem = Problem()
    check(function(*arguments, byref(problem)), problem)

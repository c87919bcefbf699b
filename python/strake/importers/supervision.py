# SPDX-License-Identifier: Apache-2.0
"""A process for what may crash."""

from __future__ import annotations

import ctypes
import mmap
import os
import signal
import sys
from collections.abc import Callable
from typing import NamedTuple

# The status of a process whose function did not come to an end.
_NO_STATUS = 70


class Crash(NamedTuple):
    """How a function in a process of its own ended: with a status, and with the name of a signal where it crashed."""

    status: int
    name: str = ""


class Attempt:
    """What a process that may crash tells the one that watches it: whether it is worth to begin anew, with more care."""

    def __init__(self) -> None:
        self._shared = mmap.mmap(-1, mmap.PAGESIZE)
        self.is_careful = not hasattr(os, "fork")

    def may_be_repeated(self, may: bool) -> None:
        """Says whether, if it crashes now, it is to be begun anew."""
        self._shared[0] = may

    def repeat(self) -> bool:
        """Whether it is to be begun anew, which it then is with care."""
        again = bool(self._shared[0]) and not self.is_careful
        self._shared[0] = False
        self.is_careful = True
        return again


def crash_of(function: Callable[[], int]) -> Crash:
    """Runs the function in a forked process, and in this one where there are no such processes."""
    if not hasattr(os, "fork"):
        return Crash(function())
    parent = os.getpid()
    child = os.fork()
    if child == 0:
        status = _NO_STATUS
        try:
            end_with_parent(parent)
            status = function()
            sys.stdout.flush()
            sys.stderr.flush()
        finally:
            os._exit(status)
    _, state = os.waitpid(child, 0)
    if os.WIFSIGNALED(state):
        return Crash(1, signal_name(os.WTERMSIG(state)))
    status = os.WEXITSTATUS(state)
    return Crash(1, "an unknown fault") if status == _NO_STATUS else Crash(status)


def signal_name(number: int) -> str:
    """Returns the name of a signal, as SIGSEGV."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def end_with_parent(parent: int) -> None:
    """Has this process killed when its parent ends, however that ends. Only Linux can do that."""
    if not sys.platform.startswith("linux"):
        return
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)

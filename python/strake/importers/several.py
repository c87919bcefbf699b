# SPDX-License-Identifier: Apache-2.0
"""Several files of one importer: libraries are loaded once, then each file has a process of its own (decision 0126).

The program `strake-import-many-SUFFIX` lies beside `strake-import-SUFFIX`. It reads lines: `run FOLDER` begins a file, whose folder has
`job.json` with the words that the importer of one file is called with, and `end FOLDER` kills what is left of it. When a
file's process has ended, a file `ended` in its folder says how. It ends when there is nothing more to read.
"""

from __future__ import annotations

import contextlib
import gc
import json
import os
import select
import signal
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from strake.importers.command import Convert, run
from strake.importers.supervision import end_with_parent

_LINE_BYTES = 1 << 16
# What a shell says of a program that is called wrongly.
_WRONG_WORDS = 2
# What Python says of a program that raised an exception.
_FAULT = 1


def run_several(convert: Convert, load: Callable[[], Any]) -> int:
    """Converts the files that the lines of standard input name, each as `run` does. `load` loads what all need."""
    if not hasattr(os, "fork"):
        return _WRONG_WORDS
    end_with_parent(os.getppid())
    # What cannot be loaded is told of each file.
    with contextlib.suppress(ImportError):
        load()
    gc.freeze()
    _Host(convert).serve()
    return 0


class _Host:
    """Begins processes, and takes notice of their ends."""

    def __init__(self, convert: Convert) -> None:
        self._convert = convert
        self._folders: dict[int, Path] = {}
        self._woken, self._wake = os.pipe()
        os.set_blocking(self._woken, False)
        os.set_blocking(self._wake, False)

    def serve(self) -> None:
        signal.signal(signal.SIGCHLD, lambda *_: None)
        signal.set_wakeup_fd(self._wake, warn_on_full_buffer=False)
        rest = b""
        while True:
            ready, _, _ = select.select([0, self._woken], [], [])
            if self._woken in ready:
                with contextlib.suppress(BlockingIOError):
                    os.read(self._woken, _LINE_BYTES)
                self._look()
            if 0 in ready:
                more = os.read(0, _LINE_BYTES)
                if not more:
                    break
                *lines, rest = (rest + more).split(b"\n")
                for line in lines:
                    self._obey(os.fsdecode(line))
        self._end_all()

    def _end_all(self) -> None:
        for process in self._folders:
            _kill(process)

    def _obey(self, line: str) -> None:
        word, _, name = line.partition(" ")
        if word == "run":
            self._begin(Path(name))
        elif word == "end":
            for process, folder in self._folders.items():
                if folder == Path(name):
                    _kill(process)

    def _begin(self, folder: Path) -> None:
        job = folder / "job.json"
        try:
            stated = json.loads(job.read_bytes())
            arguments, log = [str(word) for word in stated["arguments"]], str(stated["log"])
            job.unlink()
        except (OSError, ValueError, KeyError, TypeError):
            self._answer(folder, {"status": _WRONG_WORDS})
            return
        parent = os.getpid()
        process = os.fork()
        if process == 0:
            status = _WRONG_WORDS
            try:
                signal.set_wakeup_fd(-1)
                signal.signal(signal.SIGCHLD, signal.SIG_DFL)
                for descriptor in (self._woken, self._wake):
                    os.close(descriptor)
                os.setpgid(0, 0)
                end_with_parent(parent)
                _stand_in(folder, log)
                status = run(self._convert, arguments)
            except SystemExit as wrong:  # the words make no sense, which is said in the log
                status = wrong.code if isinstance(wrong.code, int) else _WRONG_WORDS
            except BaseException:
                # As from a program of its own.
                status = _FAULT
                with contextlib.suppress(OSError):
                    traceback.print_exc()
            finally:
                try:
                    for stream in (sys.stdout, sys.stderr):
                        with contextlib.suppress(OSError, ValueError):
                            stream.flush()
                finally:
                    os._exit(status)
        with contextlib.suppress(OSError):  # it has done so itself, or has ended
            os.setpgid(process, process)
        self._folders[process] = folder

    def _look(self) -> None:
        for process in list(self._folders):
            if os.waitid(os.P_PID, process, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
                continue
            # What it left running is found by its group as long as it is known to the system.
            _kill(process)
            _, state = os.waitpid(process, 0)
            how = {"signal": os.WTERMSIG(state)} if os.WIFSIGNALED(state) else {"status": os.WEXITSTATUS(state)}
            self._answer(self._folders.pop(process), how)

    def _answer(self, folder: Path, how: dict[str, int]) -> None:
        """Says how a file's process has ended. Whoever asked may have gone, and the folder too; whoever waits for what cannot
        be written, as on a full disk, learns of it by the end of this program, and begins anew without it."""
        try:
            written = folder / "ended.part"
            written.write_text(json.dumps(how))
            written.replace(folder / "ended")
        except OSError:
            if folder.exists():
                self._end_all()
                os._exit(_FAULT)


def _stand_in(folder: Path, log: str) -> None:
    """Works where a program that is started for the file would: in its folder, with nothing to read, and with its log."""
    os.chdir(folder)
    for descriptor, path, flags in (
        (0, os.devnull, os.O_RDONLY),
        (1, log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_APPEND),
    ):
        opened = os.open(path, flags, 0o644)
        os.dup2(opened, descriptor)
        os.close(opened)
    os.dup2(1, 2)


def _kill(process: int) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)

# SPDX-License-Identifier: Apache-2.0
"""The program `strake`, for what it does and the library does not."""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from collections.abc import Sequence
from pathlib import Path

from strake._arguments import PathLike, count, number, path, several, texts, truth, words
from strake._errors import Error, UsageError, error_of

# Exit codes of the program that are failures; 1 and 4 say what was found, not that nothing was done.
_CODES = {2: "usage", 3: "input", 5: "internal", 6: "memory", 130: "cancelled"}


_MEND = "let it name the program strake, or unset it"


def program() -> Path:
    """Where the program is: STRAKE_PROGRAM, beside this Python, or on the PATH. Raises: UsageError."""
    given = os.environ.get("STRAKE_PROGRAM")
    if given:
        if not Path(given).is_file():
            raise UsageError(f"there is no file {given}", "STRAKE_PROGRAM", _MEND)
        if not os.access(given, os.X_OK):
            raise UsageError(f"{given} may not be run", "STRAKE_PROGRAM", _MEND)
        return Path(given).absolute()
    beside = Path(sysconfig.get_path("scripts")) / "strake"
    if beside.exists():
        return beside
    found = shutil.which("strake")
    if found is None:
        raise UsageError("the program strake is not found", mend="install it, or set STRAKE_PROGRAM to where it is")
    return Path(found)


def run_program(arguments: Sequence[str | os.PathLike[str]], check: bool = True) -> subprocess.CompletedProcess[str]:
    """Runs the program `strake` with arguments as on a command line, and returns its exit code and what it wrote.

    Raises, unless `check` is false: strake.Error by the exit code, with what it wrote on standard error. Exit codes 1
    (clashes or faults found) and 4 (something was skipped) are no failures.
    """
    command = [str(program()), *words(arguments, "arguments")]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    except OSError as error:
        raise UsageError(f"{command[0]} cannot be run: {error.strerror}", "STRAKE_PROGRAM", _MEND) from error
    if truth(check, "check") and done.returncode not in (0, 1, 4):
        raise _error_of(done)
    return done


def _error_of(done: subprocess.CompletedProcess[str]) -> Error:
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    last = lines[-1] if lines else f"the program ended with {done.returncode}"
    message = last.removeprefix("strake: ").removeprefix("error: ")
    return error_of(_CODES.get(done.returncode, "internal"), message)


def evaluate(
    folder: PathLike,
    scale: float | None = None,
    only: str | Sequence[str] | None = None,
    threads: int | Sequence[int] | None = None,
    arguments: Sequence[str] = (),
) -> Path:
    """Runs `strake evaluate` and returns the folder with its page, tables and records (docs/evaluation.md).

    Args:
        folder: where to; it is made.
        scale: of the sizes of models, 1 for all.
        only: cases, as "iso" or ["iso", "dense"].
        threads: numbers of workers to measure besides one.
        arguments: further ones, as on a command line.

    Raises: strake.Error, by the program's exit code.
    """
    into = path(folder, "folder")
    command = ["evaluate", "--output", str(into)]
    if scale is not None:
        command += ["--scale", repr(number(scale, "scale"))]
    if only is not None:
        command += ["--only", ",".join(texts(only, "only"))]
    if threads is not None:
        counts = [threads] if isinstance(threads, int) else several(threads, "threads", "a number of workers, or several")
        command += ["--threads", ",".join(str(count(one, "threads")) for one in counts)]
    run_program([*command, *words(arguments, "arguments")])
    return into

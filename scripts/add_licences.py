#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""add_licences.py WHEEL INTO FOLDER...: writes into the folder INTO a copy of a wheel that also has the files of these folders.

They lie in NAME.dist-info/licenses/linked, where the metadata names them: the terms of what is linked into the wheel (decision 0115).
"""

import base64
import hashlib
import sys
import zipfile
from pathlib import Path


def texts_of(folders: list[Path]) -> dict[str, bytes]:
    """The files of some folders, by name. A folder that has none, and two files of one name, end the program."""
    texts: dict[str, bytes] = {}
    for folder in folders:
        files = sorted(file for file in folder.iterdir() if file.is_file()) if folder.is_dir() else []
        if not files:
            sys.exit(f"add_licences.py: {folder} has no files: run scripts/portable_root.sh")
        for file in files:
            # Of Python packages the file is called LICENSE: the package names it.
            name = file.name if file.suffix else f"{folder.parent.name.split('-')[0]}.txt"
            if name in texts:
                sys.exit(f"add_licences.py: two licences are called {name}: the second is {file}")
            texts[name] = file.read_bytes()
    return texts


def recorded(name: str, data: bytes) -> str:
    """A line of RECORD."""
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}"


def with_licences(metadata: bytes, names: list[str]) -> bytes:
    """The metadata with a line for each, behind the headers that are there."""
    headers, blank, description = metadata.partition(b"\n\n")
    lines = "".join(f"\nLicense-File: {name}" for name in names)
    return headers.rstrip(b"\n") + lines.encode() + (blank + description if blank else b"\n")


def main(wheel: Path, into: Path, folders: list[Path]) -> None:
    texts = texts_of(folders)
    into.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(into / wheel.name, "w", zipfile.ZIP_DEFLATED) as new:
        records = [name for name in old.namelist() if name.endswith(".dist-info/RECORD")]
        if len(records) != 1:
            sys.exit(f"add_licences.py: {wheel} is no wheel: it has no RECORD")
        info = records[0].rpartition("/")[0]
        lines = old.read(records[0]).decode().splitlines()
        for member in old.infolist():
            data = old.read(member)
            if member.filename == records[0]:
                continue
            if member.filename == f"{info}/METADATA":
                data = with_licences(data, [f"linked/{name}" for name in texts])
                lines = [line for line in lines if not line.startswith(f"{info}/METADATA,")]
                lines.append(recorded(member.filename, data))
            new.writestr(member, data)
        for name, text in texts.items():
            inside = f"{info}/licenses/linked/{name}"
            new.writestr(inside, text)
            lines.append(recorded(inside, text))
        new.writestr(records[0], "\n".join(lines) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(f"usage: {Path(sys.argv[0]).name} WHEEL INTO FOLDER...")
    main(Path(sys.argv[1]), Path(sys.argv[2]), [Path(folder) for folder in sys.argv[3:]])

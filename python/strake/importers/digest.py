# SPDX-License-Identifier: Apache-2.0
"""BLAKE2, without the library of ciphers that `hashlib` loads beside it where Python has its own: it takes 2 ms."""

from __future__ import annotations

__all__ = ["blake2b"]

try:
    from _blake2 import blake2b
except ImportError:
    from hashlib import blake2b

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# docs.sh: the guide and the reference of the installed headers as a site, in build/docs/html. A fault of
# a comment or of a link fails it.
set -euo pipefail
. scripts/common.sh
need build docs
configure release
python3 scripts/make_docs.py build/release/components.txt build/docs
say "open build/docs/html/index.html"

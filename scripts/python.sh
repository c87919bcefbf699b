#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# python.sh [ARGUMENTS of pytest]: builds the wheel into dist/ of the build folder, installs it in an environment of its
# own, and runs ruff, mypy and pytest on what is installed.
set -euo pipefail
. scripts/common.sh
need build python
venv=build/python-venv
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
say "python: what builds a wheel"
"$venv/bin/pip" install -q --disable-pip-version-check 'scikit-build-core>=1.0' 'nanobind>=3.0'
command -v node >/dev/null && scripts/npm.sh
say "python: the wheel"
rm -rf build/dist
"$venv/bin/pip" wheel -q --disable-pip-version-check --no-build-isolation --no-deps -w build/dist .
say "python: installed in a clean environment"
clean=build/python-clean
rm -rf "$clean"
python3 -m venv "$clean"
"$clean/bin/pip" install -q --disable-pip-version-check build/dist/strake-*.whl pytest ruff mypy trimesh pandas pyarrow distributed \
  'cadquery-ocp-novtk>=7.9,<8' ifcopenshell manifold3d
"$clean/bin/ruff" check .
"$clean/bin/ruff" format --check .
"$clean/bin/mypy" -p strake
"$clean/bin/python" -m pytest -q python/tests "$@"
say "python: built $(ls build/dist/strake-*.whl)"

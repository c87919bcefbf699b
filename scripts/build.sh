#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# build.sh PRESET [TARGET...]: installs the build packages and builds.
set -euo pipefail
. scripts/common.sh
preset=${1:-release}
shift || true
need build
configure_and_build "$preset" "${@:-strake}"
say "built build/$preset/bin/strake"

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# viewer.sh: builds the page that reports are made of, and runs its tests, those in Chromium too.
set -euo pipefail
. scripts/common.sh
command -v npm >/dev/null && [ "$(node -p 'parseInt(process.versions.node)')" -ge 20 ] || {
  echo "viewer: Node 20 or newer is needed (https://nodejs.org); Debian 12 has an older one" >&2
  exit 3
}
need viewer
cd viewer
npm ci --no-audit --no-fund --silent
npm run --silent build
npm run --silent lint
npm run --silent test
npm run --silent e2e
say "built viewer/built/report.html"

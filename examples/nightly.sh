#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What cron runs at night: reads again the model files that changed, tests for clashes, lists the new ones, draws stored views
# and writes the trend.
#
#     nightly.sh PROJECT REPORT [VIEW...]      as   30 22 * * 1-5  nightly.sh ship.strake /srv/report deck4 engine-room
#
# Ends with 0 where nothing is new, 1 where REPORT/new.csv has new clashes, 2 for a wrong command line; else with the exit code
# of what failed, which has said on standard error why: nothing that comes after it is done, and the project is whole.
#
# STRAKE_CLASH  options of the test, as "--rules ship.toml" (default: --clearance 25mm)
# STRAKE_WAIT   seconds to wait for somebody who writes to the project (default: 600)
set -eu
if [ $# -lt 2 ]; then
  echo "usage: $0 PROJECT REPORT [VIEW...]" >&2
  exit 2
fi
project=$1 report=$2
shift 2
wait=${STRAKE_WAIT:-600}
mkdir -p "$report"

strake project update "$project" --wait "$wait" -o "$report/changes.csv"
# The options are words.
# shellcheck disable=SC2086
strake clash -p "$project" --wait "$wait" ${STRAKE_CLASH:---clearance 25mm} -o "$report/clashes.json"
strake clash list -p "$project" --status new -o "$report/new.csv"
for view in "$@"; do
  strake draw -p "$project" --wait "$wait" --stored "$view" -o "$report/$view.svg"
done
strake clash history -p "$project" -o "$report/history.csv"

new=$(($(wc -l < "$report/new.csv") - 1))
if [ "$new" -gt 0 ]; then
  echo "$new new: $report/new.csv"
  exit 1
fi

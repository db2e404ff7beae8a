#!/usr/bin/env bash
# What the GitHub action runs, for any shell: install Drapery, check the goldens, write a summary.
#   CASES=cases.toml REPORT=drapery-report release/check_goldens.sh
# PACKAGE is what pip installs, by default the checkout with this script. VENV is the folder of the
# environment. GITHUB_STEP_SUMMARY is the file to which the table of changes is added.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
venv=${VENV:-$(mktemp -d)/venv}
python3 -m venv "$venv"
bin=$venv/bin
[ -d "$bin" ] || bin=$venv/Scripts
"$bin/python" -m pip install --quiet --disable-pip-version-check "${PACKAGE:-$here}"
report=${REPORT:-drapery-report}
exec "$bin/drapery" golden check "${CASES:-cases.toml}" --report "$report" \
  --summary "${GITHUB_STEP_SUMMARY:-/dev/stdout}"

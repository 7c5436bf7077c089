#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run.sh BUILD: tests the Python package as a wheel and as installed from the source tree, each in an environment of its
# own, and checks the types of the package. Uses Debian's Python and no network.
set -eu
[ $# = 1 ] || { echo "usage: $0 BUILD" >&2; exit 2; }
sources=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
STARFOCUS_BUILD=$build PYTHONDONTWRITEBYTECODE=1 PIP_DISABLE_PIP_VERSION_CHECK=1 MPLBACKEND=agg
export STARFOCUS_BUILD PYTHONDONTWRITEBYTECODE PIP_DISABLE_PIP_VERSION_CHECK MPLBACKEND
MPLCONFIGDIR=$work/matplotlib
export MPLCONFIGDIR
cd "$work"

# quietly COMMAND...: runs a command. Prints the output only if the command fails.
quietly() {
  "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; echo "python: failed: $*" >&2; exit 1; }
}

# install FROM: installs the package into a new environment and runs the tests there.
install() {
  rm -rf "$work/environment"
  quietly /usr/bin/python3 -m venv --system-site-packages --without-pip "$work/environment"
  python=$work/environment/bin/python
  quietly "$python" -m pip install --no-index --no-deps --no-build-isolation "$1"
  quietly "$python" "$sources/tests/python/starfocus_test.py" "$build/starfocus" "$work/scene" \
    "$sources/lib/include/starfocus"
  printf '%-40s %s\n' "$2" "$(grep '^Ran' "$work/log")"
}

quietly "$build/starfocus-lab" scene "$work/scene" --name portrait --size 320x240 --views 5
quietly /usr/bin/python3 -m pip wheel --no-index --no-deps --no-build-isolation -w "$work/wheels" \
  "$sources/platform/python"
install "$work"/wheels/starfocus-*-py3-none-*.whl 'Python, wheel'
install "$sources/platform/python" 'Python, pip install of the tree'
quietly "$python" "$sources/tests/python/reader_test.py" "$build/starfocus" "$work/scene"
printf '%-40s %s\n' 'Python, reader' "$(grep '^Ran' "$work/log")"
quietly "$python" "$sources/tests/python/frames_test.py" "$work/scene"
printf '%-40s %s\n' 'Python, streams and frames' "$(grep '^Ran' "$work/log")"
quietly "$python" "$sources/tests/python/quality_test.py"
printf '%-40s %s\n' 'Python, quality' "$(grep '^Ran' "$work/log")"
quietly "$python" "$sources/tests/python/depth_map_test.py"
printf '%-40s %s\n' 'Python, depth maps' "$(grep '^Ran' "$work/log")"
quietly /usr/bin/python3 -m mypy --config-file "$sources/platform/python/pyproject.toml" --cache-dir "$work/mypy" \
  "$sources/platform/python/starfocus" "$sources/tests/python/typed_calls.py"
printf '%-40s %s\n' 'Python, types' "$(tail -n 1 "$work/log")"
quietly "$python" "$sources/tests/python/notebook_test.py" "$sources/examples/python/tour.ipynb" "$work/scene" \
  "$work/notebook"
printf '%-40s %s\n' 'Python, notebook' "$(tail -n 1 "$work/log")"
quietly "$python" "$sources/tests/python/batch_dask_test.py" "$build/starfocus" "$work/scene" "$work/batch"
printf '%-40s %s\n' 'Python, batch with Dask' "$(tail -n 1 "$work/log")"
left=$(find "$sources/platform/python" -name '*.so' -o -name bin -o -name build -o -name '*.egg-info')
[ -z "$left" ] || { echo "python: installing left in the source tree" $left >&2; exit 1; }

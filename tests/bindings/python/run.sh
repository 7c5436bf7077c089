#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run.sh BUILD [WHEEL]: tests the Python package as a wheel and as installed from the source tree, each in a separate
# environment, and checks the types of the package. With WHEEL, tests only this wheel. Uses Debian's Python and no
# network.
set -eu
[ $# = 1 ] || [ $# = 2 ] || { echo "usage: $0 BUILD [WHEEL]" >&2; exit 2; }
sources=$(cd "$(dirname "$0")/../../.." && pwd)
tests=$sources/tests/bindings/python
build=$(cd "$1" && pwd)
wheel=${2:+$(realpath "$2")}
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

# cases LABEL COMMAND...: runs tests, and prints the number of test cases or the last line of the output.
cases() {
  label=$1
  shift
  quietly "$@"
  printf '%-40s %s\n' "$label" "$(grep '^Ran' "$work/log" || tail -n 1 "$work/log")"
}

# install FROM LABEL: installs the package into a new environment and runs the tests there.
install() {
  rm -rf "$work/environment"
  quietly /usr/bin/python3 -m venv --system-site-packages --without-pip "$work/environment"
  python=$work/environment/bin/python
  quietly "$python" -m pip install --no-index --no-deps --no-build-isolation "$1"
  cases "$2" "$python" "$tests/pictures_test.py" "$build/starfocus" "$work/scene" "$sources/lib/include/starfocus"
}

quietly "$build/starfocus-lab" scene "$work/scene" --name portrait --size 320x240 --views 5
if [ -n "$wheel" ]; then
  install "$wheel" 'Python, self-contained wheel'
  cases 'Python, reader' "$python" "$tests/reader_test.py" "$build/starfocus" "$work/scene" no-tiff
  cases 'Python, types of the wheel' /usr/bin/python3 -m mypy --config-file "$sources/platform/python/pyproject.toml" \
    --cache-dir "$work/mypy" --python-executable "$python" "$tests/typed_calls.py"
  exit
fi
quietly /usr/bin/python3 -m pip wheel --no-index --no-deps --no-build-isolation -w "$work/wheels" \
  "$sources/platform/python"
install "$work"/wheels/starfocus-*-py3-none-*.whl 'Python, wheel'
install "$sources/platform/python" 'Python, pip install of the tree'
cases 'Python, reader' "$python" "$tests/reader_test.py" "$build/starfocus" "$work/scene"
cases 'Python, maps' "$python" "$tests/maps_test.py"
cases 'Python, types' /usr/bin/python3 -m mypy --config-file "$sources/platform/python/pyproject.toml" \
  --cache-dir "$work/mypy" "$sources/platform/python/starfocus" "$tests/typed_calls.py"
cases 'Python, documents' "$python" "$tests/documents_test.py" "$work/scene" "$work/documents" \
  "$sources/docs/bindings.md" "$sources/platform/python/README.md" "$sources/examples/python/tour.ipynb"
cases 'Python, batch with Dask' "$python" "$tests/batch_dask_test.py" "$build/starfocus" "$work/scene" "$work/batch"
# A wheel with shared libraries of this machine is not self-contained.
tag=$sources/toolchains/packaging/tag_wheel.py
if /usr/bin/python3 "$tag" "$work"/wheels/starfocus-*.whl "$work" >"$work/log" 2>&1; then
  echo "python: expected tag_wheel.py to reject a wheel that needs libhwy.so, but it accepted the wheel" >&2
  exit 1
fi
grep -q 'expected only libraries of glibc, found lib' "$work/log" || { cat "$work/log" >&2; exit 1; }
# The source archive must contain all files that CMake requires.
(cd "$sources/platform/python" && quietly /usr/bin/python3 setup.py sdist --dist-dir "$work/archive")
tar -xf "$work"/archive/starfocus-*.tar.gz -C "$work/archive"
cases 'Python, source archive' cmake -S "$work"/archive/starfocus-*/sources -B "$work/archive/build" -DSTARFOCUS_TESTS=OFF \
  -DSTARFOCUS_INSTALL=OFF
left=$(find "$sources/platform/python" -name '*.so' -o -name bin -o -name build -o -name '*.egg-info')
[ -z "$left" ] || { echo "python: installing left in the source tree" $left >&2; exit 1; }

# SPDX-License-Identifier: Apache-2.0
# Command of ./do that builds a wheel and a source archive of the Python package; sourced by ./do.

# wheel [test]: builds the source archive and the wheel of HEAD in build/wheel. With `test`, also runs the tests of the
# Python package with the wheel, and installs both into bare Debians.
wheel() {
  local folder=build/wheel
  case "${1:-}" in test | '') ;; *) fail "usage: ./do wheel [test]" ;; esac
  require dpkg-dev python3-pip python3-setuptools python3-wheel
  step wheel "building the wheel and the source archive in $folder" toolchains/packaging/build_wheel.sh $folder
  tail -n 1 "$LOGS/wheel.log"
  ls $folder/starfocus-*
  [ "${1:-}" = test ] || return 0
  require debootstrap twine python3-mypy python3-numpy python3-pil
  build starfocus starfocus_lab
  step twine "checking the description" twine check $folder/starfocus-*
  tests/python/run.sh $BUILD $folder/starfocus-*.whl || exit 1
  toolchains/packaging/test_wheel.sh $folder $BUILD || exit 1
}

#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: ./do COMMAND
#
#   demo    build, make a demo light field and refocus it
#   build [TARGET...]  build Release into build/release (the program: build/release/starfocus; cmake --install
#           build/release puts it where it is found; beside it starfocus-lab for developers)
#   test    build, and run all tests but the longest, which take half of the time
#           --all    every test
#   check   the tests under sanitizers with every fixed-point range checked, but those of sources and of
#           examples/lab/analysis, then a few cases under valgrind
#   fuzz [SECONDS]  run every fuzz target that long (60), new inputs kept in build/fuzz/inputs
#   mutate [FILE...|--since REV]  change one small thing at a time (in a copy) and tell which changes no test
#           notices; --sample N of them (50); --help tells the rest
#   bench   time and error of every mode, with a report: build/bench/report.html
#           --quick   small pictures, few of them: a minute or two
#           --speed   only compares the time with shift-and-add of 13 views, at each vector width of the machine
#           --check   only compares instruction counts with examples/lab/bench/baseline.txt
#           --record  writes that file anew
#           --micro   only times kernels, the line scan and small pictures
#           --flicker only measures the flicker of a clip, and compares it with examples/lab/bench/flicker.txt
#   golden  record tests/lib/golden.txt anew, after an intended change of the engine's output
#   format  clang-format every source file, and name the licence in new ones
#   lint    check that no file or function is too large, and print the sizes of lib and simd by room
#   docs    make the HTML reference of the public headers: build/docs/html/index.html
#   help    this text
#
# Each command first installs the Debian packages that it lacks with apt-get, as root or with sudo. Commands for other
# tasks print a text like this one after --help:
#
#   toolchains/board/board        boards: cross builds, an emulated board, instruction counts, sizes
#   toolchains/packaging/package  Debian packages; beside it wheel (Python), release and bare (a bare Debian)
#   toolchains/site/site          the web site; beside it web (the npm package and the page to tap)
#   tests/bindings/run.sh         projects outside the tree that use starfocus
. "$(dirname "$0")/toolchains/steps.sh"

FUZZ_TARGETS="engine depth images files folder heif layouts photo xmp differential"

# none COMMAND [ARGUMENT...]: fails if a command that takes no arguments got one.
none() { [ $# = 1 ] || wrong "$1: expected no arguments, found '$2'"; }

configure() {
  local generator=
  [ -f $BUILD/CMakeCache.txt ] || ! command -v ninja >/dev/null || generator='-G Ninja'
  step configure "configuring $BUILD" cmake -S . -B $BUILD -DCMAKE_BUILD_TYPE=Release $generator
}

# build [TARGET...]: builds everything, or the given targets.
build() {
  local what=${*:-everything}
  [ $# -le 2 ] || what="$# targets"
  install build
  configure
  step build "building $what in $BUILD" cmake --build $BUILD --parallel "$(nproc)" --target "${@:-all}"
}

# refocus NAME: refocuses demo/portrait at the object NAME, whose position is in meta.txt. The program prints the picture's
# name, focus and aperture.
refocus() {
  local place
  place=$(sed -n "s/^$1: *\([0-9,]*\).*/\1/p" demo/portrait/meta.txt)
  $BUILD/starfocus refocus demo/portrait -o "demo/$1.png" --focus-at "$place" || fail "refocusing at the $1 object: failed"
}

demo() {
  build starfocus starfocus_lab
  mkdir -p demo
  lab "made the light field demo/portrait" scene demo/portrait --name portrait --size 640x480
  refocus near
  refocus middle
  refocus far
  lab "put the three side by side: demo/sheet.png" \
    sheet demo/near.png demo/middle.png demo/far.png --labels near,middle,far -o demo/sheet.png
}

# run_tests [--all]: runs all tests, or those without the label `all`.
run_tests() {
  local labels=(--label-exclude '^all$')
  case "$*" in '') ;; --all) labels=() ;; *) wrong "test: expected --all or nothing, found '$*'" ;; esac
  install test
  build
  ctest --test-dir $BUILD --output-on-failure --parallel "$(nproc)" "${labels[@]}" || exit 1
  [ $# != 0 ] || echo "The longest tests were left out; ./do test --all runs every test."
}

# build_sanitized TARGET...: builds these targets with clang, for sanitizers and libFuzzer.
build_sanitized() {
  install build fuzz
  step configure-sanitize "configuring build/sanitize" cmake --preset sanitize -DSTARFOCUS_DATA_DIR=
  step build-sanitize "building in build/sanitize" cmake --build build/sanitize --parallel "$(nproc)" --target "$@"
}

# Runs the tests under AddressSanitizer and UBSan with range checks, and a few cases under valgrind. Tests with data
# sets, tests of examples/lab/analysis and tests of the source tree are skipped, since sanitizers find nothing in these
# tests. AddressSanitizer keeps one stack frame per allocation, because whole stacks make the conformance tests four
# times slower. To get whole stacks, set ASAN_OPTIONS=malloc_context_size=30. Valgrind finds invalid addresses and
# undefined values. The random calls of operations_bytes_test.cc compare all output bytes, and leave the workspace
# uninitialized in some cases.
check() {
  install valgrind
  build
  export ASAN_OPTIONS=${ASAN_OPTIONS:-malloc_context_size=1}
  build_sanitized all
  ctest --test-dir build/sanitize --output-on-failure --parallel "$(nproc)" || exit 1
  STARFOCUS_SECONDS=30 step valgrind "refocusing under valgrind" tests/support/valgrind.sh $BUILD --quiet \
    --error-exitcode=1 $BUILD/tests/operations_byte_tests --no-intro=true '--test-case=ways: random*'
}

# fuzz_target SECONDS NAME: runs the fuzz target NAME, starting from the seeds and from inputs that earlier runs found.
# In a clean checkout all runs are identical, so a failure is caused by the change under test.
fuzz_target() {
  local work=build/fuzz/inputs/$2 length=1024
  case "$2" in heif | layouts | photo | xmp) length=4096 ;; esac
  mkdir -p "$work"
  LSAN_OPTIONS=suppressions=tests/fuzz/leaks.supp:print_suppressions=0 build/sanitize/tests/fuzz/fuzz_$2 \
    -max_total_time="$1" -seed=1 -max_len=$length -timeout=30 -rss_limit_mb=1024 -malloc_limit_mb=512 \
    -print_final_stats=1 -artifact_prefix="$work-crash-" "$work" "tests/fuzz/corpus/$2" >"$LOGS/fuzz-$2.log" 2>&1 && return
  tail -n 40 "$LOGS/fuzz-$2.log"
  echo "the fuzz target $2 failed; its whole log is $LOGS/fuzz-$2.log"
  return 1
}

fuzz() {
  local target seconds=${1:-60}
  [ $# -le 1 ] && [[ $seconds =~ ^[0-9]+$ ]] || wrong "fuzz: expected a number of seconds, found '$*'"
  build_sanitized $(printf 'starfocus_fuzz_%s ' $FUZZ_TARGETS)
  step fuzz "fuzzing $(wc -w <<<"$FUZZ_TARGETS") targets" side_by_side "fuzz_target $seconds" $FUZZ_TARGETS
  for target in $FUZZ_TARGETS; do
    printf '%s: %s inputs\n' "$target" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$LOGS/fuzz-$target.log")"
  done
}

# Updates the checksums in tests/lib/golden.txt.
golden() {
  build starfocus_lib_byte_tests
  STARFOCUS_RECORD_GOLDEN=1 $BUILD/tests/lib_byte_tests --no-intro=true '--source-file=*/golden_bytes_test.cc'
}

format() {
  local licence='SPDX-License-Identifier: Apache-2.0'
  install clang-format
  sources() {
    find lib simd platform examples tests toolchains \( -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cc' -o \
      -name '*.java' \) "$@"
  }
  sources -exec grep -L "$licence" {} + | while read -r file; do sed -i "1i // $licence" "$file"; done
  sources -exec clang-format -i {} +
}

# Runs clang-tidy on all sources of these folders with the checks of the nearest file .clang-tidy. Prints only findings.
tidy() (
  set -o pipefail
  sed -n 's/^ *"file": "\(.*\)"$/\1/p' $BUILD/compile_commands.json |
    grep -E "^$PWD/($BUILD/)?(lib|simd|platform|examples)/" |
    sort -u | xargs -d '\n' -P "$(nproc)" -n 4 clang-tidy -p $BUILD --quiet 2>&1 | sed '/ generated\.$/d'
)

lint() {
  install build clang-tidy universal-ctags python3
  configure
  toolchains/rooms.py || fail "a file is too long"
  step lint "checking the sizes of functions" tidy
}

docs() {
  install doxygen
  rm -rf build/docs && mkdir -p build/docs
  step docs "making build/docs/html/index.html" doxygen docs/Doxyfile
}

[ $# -gt 0 ] || set -- help
help_if_asked "$@"
case "$1" in
  build) shift && build "$@" ;;
  test) shift && run_tests "$@" ;;
  fuzz) shift && fuzz "$@" ;;
  mutate) shift && install build python3 && tests/source/mutate "$@" ;;
  bench) shift && examples/lab/bench/run.sh "$@" ;;
  demo | check | golden | format | lint | docs) none "$@" && "$1" ;;
  *) wrong "expected a command, found '$1'" ;;
esac

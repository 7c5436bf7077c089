#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs the tasks of a developer; ./do help lists these tasks.
set -u
cd "$(dirname "$0")" || exit 1

BUILD=build/release
LOGS=build/log
PROGRAM=$BUILD/starfocus
LAB=$BUILD/starfocus-lab
PACKAGES="g++ cmake ninja-build pkg-config libhwy-dev libstb-dev doctest-dev libcli11-dev nlohmann-json3-dev
  libjpeg62-turbo-dev libpng-dev libdeflate-dev libtiff-dev libwebp-dev libexpat1-dev libexif-dev libheif-dev
  libsixel-dev libseccomp-dev"
# Packages with programs that the tests use to check files written by starfocus.
JUDGES="libimage-exiftool-perl webp libsixel-bin"
FUZZ_PACKAGES="clang libclang-rt-14-dev"
FUZZ_TARGETS="engine depth images files folder heif layouts photo xmp differential"
export LC_ALL=C.UTF-8

help() {
  cat <<'TEXT'
usage: ./do COMMAND

  demo    install what is missing, build, make a demo light field and refocus it
  test    install what is missing, build and run every test
  check   the tests under sanitizers with every fixed-point range checked, but those of sources and
          of examples/lab/analysis, then a few cases under valgrind
  mutate [FILE...|--since REV]  change one small thing at a time (in a copy) and tell which changes
          no test notices; --sample N of them (50); --help tells the rest
  fuzz [SECONDS]  run every fuzz target that long (60), new inputs kept in build/fuzz/inputs
  consumers [KIND...]  build and run projects outside the tree that use starfocus: package, source,
          m32, wasm, python, java, swift (all of them), the preset of a board that was built, or
          java-aarch64, emulated
  build   install what is missing, build Release into build/release (the program:
          build/release/starfocus; cmake --install build/release puts it where it is found; beside
          it starfocus-lab for developers)
  bench   time and error of every mode, with a report: build/bench/report.html
          --quick   small pictures, few of them: a minute or two
          --check   only compares instruction counts with examples/lab/bench/baseline.txt
          --record  writes that file anew
          --micro   only times kernels, the line scan and small pictures
  cross ARCH [build|bytes]   build for aarch64, armhf, armv6 or riscv64 and run every test emulated;
          bytes: only tests that compare all bytes
  boot    run the board program on an emulated board: its GPIO lines, buttons and screen
  count [record]  AArch64 instructions per pixel against toolchains/board/instruction_counts.txt
  size [write]   what boards need: code, stack and memory (write: into docs/boards.md)
  web [PORT]  build the npm package and a page to tap, and serve it on the loopback (8080)
          build   only makes them: build/web/npm and build/web/site, a static folder
          test    tries the package in node and the page in Chromium
  package [arm64|armhf] [test]  build Debian packages of the last commit in build/packages, and check
          them with lintian; arm64 and armhf: for these machines, in build/packages-ARCH (as root);
          test: also install, run and remove them in a bare Debian, emulated if necessary (as root)
  release VERSION  make all files of a release from a clean clone in build/release-VERSION/files
          VERSION twice  also in another folder, and compare all bytes
          --dry-run      only the files that need no compilation, and the ABI
  wheel [test]  build a self-contained wheel and a source archive of the Python package in build/wheel;
          test: also install both into a bare Debian 12, and the wheel into a bare Debian 13 with
          numpy 2 (as root)
  docs    make the HTML reference of the public headers: build/docs/html/index.html
  site    make the static site build/site from the documents, the reference, a gallery and the page
          to tap, and check its links
  golden  record tests/engine/golden.txt anew, after an intended change of the engine's output
  format  clang-format every source file, and name the licence in new ones
  lint    check that no file or function is too large, and print the sizes of lib and simd by room
  bare [COMMAND...]  run every command that installs packages, or the given ones, in separate copies
          of a bare Debian 12 with git, and print a table of the results (as root; takes hours)
  help    this text

Packages are installed with apt-get, as root or with sudo, and only when absent.
TEXT
}

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# fit TEXT COLUMNS: prints the start of the text that COLUMNS columns of a terminal can show. Characters outside of ASCII
# count as two columns, the width of the widest characters.
fit() {
  local text=${1:0:$2} wide
  wide=${text//[ -~]/}
  while [ $((${#text} + ${#wide})) -gt "$2" ]; do
    text=${text%?}
    wide=${text//[ -~]/}
  done
  printf '%s' "$text"
}

# watch LABEL LOG: prints the last line of the log while a step runs, in one line of the terminal.
watch() {
  local size columns
  exec 3<&1
  while kill -0 $$ 2>/dev/null; do
    size=$(stty size <&3 2>/dev/null)
    columns=${size#* }
    [ "${columns:-0}" -gt 0 ] || columns=80
    printf '\r\033[K%s' "$(fit "$1: $(tail -n 1 "$2" | tr '\t' ' ' | tr -d '[:cntrl:]')" $((columns - 1)))"
    sleep 0.3
  done
}

# logged LABEL LOG COMMAND...: runs a command with its output in the file LOG, and prints the last line of the output
# while the command runs.
logged() {
  local label=$1 log=$2 watcher= result=0
  shift 2
  mkdir -p "${log%/*}" && : >"$log" || exit 1
  if [ -t 1 ]; then
    watch "$label" "$log" &
    watcher=$!
  fi
  "$@" >"$log" 2>&1 </dev/null || result=$?
  if [ -n "$watcher" ]; then
    kill $watcher
    wait $watcher 2>/dev/null
    printf '\r\033[K'
  fi
  return $result
}

# step NAME LABEL COMMAND...: runs a command with its output in build/log/NAME.log. If the command fails, prints the
# log.
step() {
  local label=$2 log=$LOGS/$1.log start=$SECONDS
  shift 2
  if ! logged "$label" "$log" "$@"; then
    tail -n 40 "$log" >&2
    fail "$label: failed; the whole log is $log"
  fi
  printf '%s (%d s)\n' "$label" $((SECONDS - start))
}

# has_header NAME: true if the compiler finds the header, including in the folders that CMake searches first.
has_header() {
  local IFS=: prefix folders=()
  for prefix in ${CMAKE_PREFIX_PATH:-}; do folders+=("-I$prefix/include"); done
  echo "#include <$1>" | "${CXX:-c++}" "${folders[@]}" -E -x c++ - >/dev/null 2>&1
}

# has PACKAGE: true if the files that starfocus uses from the package exist, whether or not a package installed these
# files.
has() {
  case "$1" in
    g++) command -v "${CXX:-c++}" ;;
    ninja-build) command -v ninja ;;
    gnuplot-nox) command -v gnuplot ;;
    qemu-user) command -v qemu-aarch64 ;;
    qemu-system-arm) command -v qemu-system-aarch64 ;;
    emscripten) command -v emcc ;;
    nodejs) command -v node ;;
    openjdk-*) command -v javac && command -v jar ;;
    kotlin) command -v kotlinc ;;
    g++-*-linux-*) command -v "${1#g++-}-g++" ;;
    libhwy-dev) has_header hwy/highway.h ;;
    libstb-dev) has_header stb/stb_image.h ;;
    doctest-dev) has_header doctest/doctest.h ;;
    libcli11-dev) has_header CLI/CLI.hpp ;;
    nlohmann-json3-dev) has_header nlohmann/json.hpp ;;
    libjpeg62-turbo-dev) has_header jpeglib.h ;;
    libpng-dev) has_header png.h ;;
    libdeflate-dev) has_header libdeflate.h ;;
    libtiff-dev) has_header tiffio.h ;;
    libwebp-dev) has_header webp/mux.h ;;
    libimage-exiftool-perl) command -v exiftool ;;
    webp) command -v webpinfo ;;
    libexpat1-dev) has_header expat.h ;;
    libexif-dev) has_header libexif/exif-data.h ;;
    libheif-dev) has_header libheif/heif.h ;;
    libsixel-dev) has_header sixel/sixel.h ;;
    libseccomp-dev) has_header seccomp.h ;;
    libsixel-bin) command -v sixel2png ;;
    universal-ctags) ctags --version 2>/dev/null | grep Universal ;;
    libbenchmark-dev) has_header benchmark/benchmark.h ;;
    lib*) false ;;
    *) command -v "$1" ;;
  esac >/dev/null
}

# Sets $missing to the packages of $PACKAGES that are missing. The package database of Debian is queried only for
# packages whose files were not found.
find_missing() {
  local package
  missing=
  for package in $PACKAGES; do
    has "$package" ||
      dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      missing="$missing $package"
  done
  missing=${missing# }
}

apt() {
  if [ "$(id -u)" = 0 ]; then
    DEBIAN_FRONTEND=noninteractive apt-get -y -q "$@"
  else
    sudo -n env DEBIAN_FRONTEND=noninteractive apt-get -y -q "$@"
  fi
}

# Updates the package lists only if the installation fails with the current lists.
install_packages() {
  apt install --no-install-recommends $missing && return
  apt update && apt install --no-install-recommends $missing
}

install_missing() {
  find_missing
  [ -n "$missing" ] || return 0
  command -v apt-get >/dev/null ||
    fail "starfocus needs these Debian packages, and there is no apt-get to install them: $missing"
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null ||
      fail "starfocus needs these packages; install them as root: apt-get install $missing"
    sudo -v || fail "starfocus needs root's leave to install: $missing"
  fi
  step install "installing $(wc -w <<<"$missing") packages" install_packages
}

configure() {
  if [ -f $BUILD/CMakeCache.txt ]; then
    step configure "configuring $BUILD" cmake -S . -B $BUILD -DCMAKE_BUILD_TYPE=Release
  elif command -v ninja >/dev/null; then
    step configure "configuring $BUILD" cmake -S . -B $BUILD -DCMAKE_BUILD_TYPE=Release -G Ninja
  else
    step configure "configuring $BUILD" cmake -S . -B $BUILD -DCMAKE_BUILD_TYPE=Release
  fi
}

# build [TARGET...]: builds everything, or the given targets.
build() {
  local what=${*:-everything}
  [ $# -le 2 ] || what="$# targets"
  configure
  step build "building $what in $BUILD" \
    cmake --build $BUILD --parallel "$(nproc)" --target "${@:-all}"
}

# lab LABEL ARGUMENT...: runs starfocus-lab, which prints progress if stderr is a terminal.
lab() {
  local label=$1 start=$SECONDS
  shift
  $LAB "$@" >/dev/null || fail "$label: failed"
  printf '%s (%d s)\n' "$label" $((SECONDS - start))
}

# refocus NAME: refocuses demo/portrait at the object NAME, whose position is in meta.txt. The program prints the picture's
# name, focus and aperture.
refocus() {
  local place
  place=$(sed -n "s/^$1: *\([0-9,]*\).*/\1/p" demo/portrait/meta.txt)
  $PROGRAM refocus demo/portrait -o "demo/$1.png" --focus-at "$place" || fail "refocusing at the $1 object: failed"
}

demo() {
  install_missing
  build starfocus starfocus_lab
  mkdir -p demo
  lab "made the light field demo/portrait" scene demo/portrait --name portrait --size 640x480
  refocus near
  refocus middle
  refocus far
  lab "put the three side by side: demo/sheet.png" \
    sheet demo/near.png demo/middle.png demo/far.png --labels near,middle,far -o demo/sheet.png
}

# Runs the tests under AddressSanitizer and UBSan with range checks. Tests with data sets, tests of examples/lab/analysis and
# tests of the source tree are skipped, since sanitizers find nothing in these tests. AddressSanitizer keeps one stack
# frame per allocation, because whole stacks make the conformance tests four times slower. To get whole stacks, set
# ASAN_OPTIONS=malloc_context_size=30.
sanitize() {
  export ASAN_OPTIONS=${ASAN_OPTIONS:-malloc_context_size=1}
  build_sanitized all
  ctest --test-dir build/sanitize --output-on-failure --parallel "$(nproc)" || exit 1
}

# build_sanitized TARGET...: builds these targets with clang, for sanitizers and libFuzzer.
build_sanitized() {
  step configure-sanitize "configuring build/sanitize" \
    cmake --preset sanitize -DSTARFOCUS_DATA_DIR=
  step build-sanitize "building in build/sanitize" \
    cmake --build build/sanitize --parallel "$(nproc)" --target "$@"
}

run_tests() {
  PACKAGES="$PACKAGES $JUDGES"
  install_missing
  build
  ctest --test-dir $BUILD --output-on-failure --parallel "$(nproc)"
}

# Runs the tests under sanitizers with range checks, and a few cases under valgrind.
check() {
  PACKAGES="$PACKAGES $FUZZ_PACKAGES valgrind"
  install_missing
  build
  sanitize
  # valgrind finds invalid addresses and undefined values. The stress family `differential` compares all output bytes,
  # and leaves the workspace uninitialized in some cases.
  step valgrind "refocusing under valgrind" tests/support/valgrind.sh $BUILD --quiet \
    --error-exitcode=1 $LAB stress --seconds 30 --family differential
}

# Builds the library and downloads a Java run time for the Java test on an emulated board.
java_aarch64() {
  prepare_board aarch64
  step java-aarch64 "fetching Java for aarch64" \
    toolchains/fetch.sh arm64 build/sysroot/java-arm64 zlib1g openjdk-17-jre-headless
  cross_build aarch64 starfocus_jni
}

# consumers [KIND...]: builds and runs projects outside the tree that use starfocus.
consumers() {
  local kind target targets='starfocus starfocus_lab starfocus_shared' python=python3
  if [ $# = 0 ]; then
    set -- package source wasm python java swift
    [ "$(uname -m)" != x86_64 ] || set -- "$@" m32
  fi
  for kind in "$@"; do
    case "$kind" in
      m32) PACKAGES="$PACKAGES libc6-dev-i386 lib32stdc++-12-dev qemu-user" ;;
      wasm) PACKAGES="$PACKAGES emscripten nodejs" ;;
      python)
        for target in numpy pip venv setuptools wheel pil matplotlib distributed mypy; do python="$python python3-$target"; done
        PACKAGES="$PACKAGES $python"
        targets="$targets starfocus_python"
        ;;
      java*)
        PACKAGES="$PACKAGES openjdk-17-jdk-headless kotlin python3 zip android-platform-frameworks-native-headers"
        targets="$targets starfocus_jni starfocus_phone"
        ;;
      swift) PACKAGES="$PACKAGES clang" ;;
    esac
  done
  install_missing
  case " $* " in *' java-aarch64 '*) java_aarch64 ;; esac
  build $targets
  tests/consumers/run.sh $BUILD "$@" || exit 1
}

# side_by_side COMMAND ITEM...: runs the command with each item, in parallel on all cores.
side_by_side() {
  local command=$1 item running=() result=0
  shift
  for item; do
    if [ ${#running[@]} -ge "$(nproc)" ]; then
      wait "${running[0]}" || result=1
      running=("${running[@]:1}")
    fi
    $command "$item" &
    running+=($!)
  done
  for item in "${running[@]}"; do wait "$item" || result=1; done
  return $result
}

# fuzz_target SECONDS NAME: runs the fuzz target NAME, starting from the seeds and from inputs that earlier runs found.
# In a clean checkout all runs are identical, so a failure is caused by the change under test.
fuzz_target() {
  local work=build/fuzz/inputs/$2 length=1024
  case "$2" in heif | layouts | photo | xmp) length=4096 ;; esac
  mkdir -p "$work"
  LSAN_OPTIONS=suppressions=tests/fuzz/leaks.supp:print_suppressions=0 build/sanitize/tests/fuzz/fuzz_$2 -max_total_time="$1" -seed=1 -max_len=$length -timeout=30 \
    -rss_limit_mb=1024 -malloc_limit_mb=512 -print_final_stats=1 -artifact_prefix="$work-crash-" "$work" "tests/fuzz/corpus/$2" \
    >"$LOGS/fuzz-$2.log" 2>&1 && return
  tail -n 40 "$LOGS/fuzz-$2.log"
  echo "the fuzz target $2 failed; its whole log is $LOGS/fuzz-$2.log"
  return 1
}

fuzz() {
  local target
  case "$1" in *[!0-9]* | '') fail "fuzz: expected a number of seconds, found '$1'" ;; esac
  PACKAGES="$PACKAGES $FUZZ_PACKAGES"
  install_missing
  build_sanitized $(printf 'starfocus_fuzz_%s ' $FUZZ_TARGETS)
  step fuzz "fuzzing $(wc -w <<<"$FUZZ_TARGETS") targets" side_by_side "fuzz_target $1" $FUZZ_TARGETS
  for target in $FUZZ_TARGETS; do
    printf '%s: %s inputs\n' "$target" \
      "$(sed -n 's/^stat::number_of_executed_units: *//p' "$LOGS/fuzz-$target.log")"
  done
}

docs() {
  require doxygen
  rm -rf build/docs && mkdir -p build/docs
  step docs "making build/docs/html/index.html" doxygen docs/Doxyfile
}

mutate() {
  require ninja-build python3
  tests/mutation/mutate "$@"
}

# Runs clang-tidy on all sources of these folders with the checks of the nearest file .clang-tidy. Prints only findings.
tidy() (
  set -o pipefail
  sed -n 's/^ *"file": "\(.*\)"$/\1/p' $BUILD/compile_commands.json |
    grep -E "^$PWD/($BUILD/)?(lib|simd|platform|examples)/" |
    sort -u | xargs -d '\n' -P "$(nproc)" -n 4 clang-tidy -p $BUILD --quiet 2>&1 | sed '/ generated\.$/d'
)

lint() {
  require clang-tidy universal-ctags python3
  configure
  toolchains/rooms.py || fail "a file is too long"
  step lint "checking the sizes of functions" tidy
}

# require PACKAGE...: installs the given packages, in addition to $PACKAGES, unless they are installed.
require() {
  PACKAGES="$PACKAGES $*"
  install_missing
}

# bench_scene NAME ARGUMENT...: renders a scene for the bench unless the scene already exists.
bench_scene() {
  local folder=build/bench/$1
  shift
  [ -f "$folder/meta.txt" ] || lab "made the light field $folder" scene "$folder" "$@"
}

check_counts() {
  require valgrind
  build starfocus_lab starfocus_valgrind starfocus-bench-count starfocus_instruction_bench
  examples/lab/bench/count.sh $BUILD "$1"
}

bench() {
  local folder fields options
  case "${1:-}" in
    --check) check_counts check; return ;;
    --record) check_counts record; return ;;
    --micro)
      require libbenchmark-dev
      build starfocus-bench-micro
      $BUILD/starfocus-bench-micro || fail "the micro bench failed"
      return
      ;;
    --quick)
      fields=build/bench/portrait-small
      options="--quantiles 0.1,0.5,0.9 --repetitions 3 --patience 0.5 --views 5,9 --max-layers 0,1 --rules
        --n-scales 0.5,0.7,1,1.4,2 --targets all --workers 2 --largest-radius 16 --largest-size 1" ;;
    '')
      fields="build/bench/portrait build/bench/ramp build/bench/hair-scene"
      options="--quantiles 0.1,0.3,0.5,0.7,0.9 --apertures 1,0.5,0.25 --views 5,9 --max-layers 0,1 --rules
        --n-scales 0.5,0.7,1,1.4,2 --superblocks 32,128,256 --targets all --workers 2 --largest-radius 64 --largest-size 16" ;;
    *) help >&2; exit 1 ;;
  esac
  require gnuplot-nox python3
  build starfocus_lab starfocus-bench
  mkdir -p build/bench
  bench_scene portrait-small --name portrait --size 512x384 --truth=3.5,1
  if [ -z "${1:-}" ]; then
    bench_scene portrait --name portrait --truth=7.84,1 --truth=-8.6,1
    bench_scene ramp --name ramp --size 512x384
    bench_scene hair-scene --name hair --truth=10,1 --truth=-11.4,1
    for folder in ../shared/data/*/; do
      [ -f "$folder/disparity.pfm" ] && fields="$fields $folder"
    done
  fi
  $BUILD/starfocus-bench $fields $options --sweep build/bench/portrait-small \
    --revision "$(git rev-parse --short HEAD 2>/dev/null)" --csv build/bench/results.csv \
    --json build/bench/results.json || fail "the bench failed"
  python3 examples/lab/bench/report.py build/bench/results.json examples/lab/bench/baseline.txt toolchains/board/instruction_counts.txt \
    >build/bench/report.html || fail "the report failed"
  echo "report: build/bench/report.html; rows: build/bench/results.csv and .json"
}

format() {
  local PACKAGES=clang-format licence='SPDX-License-Identifier: Apache-2.0'
  install_missing
  sources() {
    find lib simd platform examples tests \( -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cc' -o \
      -name '*.java' \) "$@"
  }
  sources -exec grep -L "$licence" {} + | while read -r file; do sed -i "1i // $licence" "$file"; done
  sources -exec clang-format -i {} +
}

. toolchains/commands.sh
. toolchains/web.sh
. toolchains/site/site.sh
. toolchains/packaging/bare.sh
. toolchains/packaging/packages.sh
. toolchains/packaging/release.sh
. toolchains/packaging/wheel.sh

case "${1:-help}" in
  demo) demo ;;
  test) run_tests ;;
  check) check ;;
  build) install_missing && build ;;
  consumers) shift && consumers "$@" ;;
  fuzz) fuzz "${2:-60}" ;;
  mutate) shift && mutate "$@" ;;
  bench) bench "${2:-}" ;;
  cross) shift && cross "$@" ;;
  docs) docs ;;
  site) site ;;
  package) shift && package "$@" ;;
  release) shift && release "$@" ;;
  wheel) wheel "${2:-}" ;;
  golden) golden ;;
  boot) boot ;;
  web) web "${2:-}" ;;
  count) count_command "${2:-}" ;;
  size) size "${2:-}" ;;
  format) format ;;
  lint) lint ;;
  bare) shift && bare "$@" ;;
  help | -h | --help) help ;;
  *) help >&2; exit 1 ;;
esac

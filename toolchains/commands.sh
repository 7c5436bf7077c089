# SPDX-License-Identifier: Apache-2.0
# Commands of ./do for boards; sourced by ./do.

# board ARCHITECTURE: sets the compiler's Debian package, the emulator and the sysroot of a preset.
board() {
  case "$1" in
    aarch64) board_compiler=g++-aarch64-linux-gnu board_sysroot=arm64 ;;
    armhf) board_compiler=g++-arm-linux-gnueabihf board_sysroot=armhf ;;
    armv6) board_compiler=g++-arm-linux-gnueabi board_sysroot=armel ;;
    riscv64) board_compiler=g++-riscv64-linux-gnu board_sysroot=headers ;;
    *) fail "expected aarch64, armhf, armv6 or riscv64, found '$1'" ;;
  esac
}

# emulator PRESET: prints the emulator of statically linked programs for a board.
emulator() {
  case "$1" in
    aarch64) echo qemu-aarch64 -cpu cortex-a53 ;;
    armhf) echo qemu-arm -cpu cortex-a7 ;;
    armv6) echo qemu-arm -cpu arm1176 ;;
    riscv64) echo qemu-riscv64 -cpu rv64 ;;
  esac
}

# cross_build PRESET [TARGET...]: cross-builds everything, or the given targets.
cross_build() {
  local preset=$1
  shift
  step "configure-$preset" "configuring build/$preset" cmake --preset "$preset"
  step "build-$preset" "building ${*:-everything} in build/$preset" \
    cmake --build --preset "$preset" --parallel "$(nproc)" ${1:+--target "$@"}
}

# sve_test BYTES:NAME: runs one test with SVE registers of BYTES bytes.
sve_test() {
  local bytes=${1%:*} name=${1#*:}
  qemu-aarch64 -cpu max,sve-default-vector-length=$bytes -L /usr/aarch64-linux-gnu \
    -E LD_LIBRARY_PATH=build/sysroot/arm64/usr/lib/aarch64-linux-gnu \
    build/aarch64-max/tests/simd_byte_tests --no-intro=true "--source-file=*/${name}_bytes_test.cc" \
    >"$LOGS/$name-$bytes.log" 2>&1 && return
  echo "${name}_bytes_test failed with SVE registers of $bytes bytes: see $LOGS/$name-$bytes.log" >&2
  return 1
}

# Runs the kernel tests with several lengths of SVE registers. Tests of whole pictures are not required, since pictures
# consist of kernel results.
by_sve_length() {
  local bytes tests=
  cross_build aarch64-max starfocus_simd_byte_tests
  for bytes in 16 32 64; do
    tests="$tests $bytes:kernels $bytes:depth_kernels $bytes:image_kernels"
  done
  step sve "kernels with SVE registers of 16, 32 and 64 bytes" side_by_side sve_test $tests
  grep -h '^SIMD targets:' "$LOGS"/kernels-??.log
}

# into_boards NAME FILE: replaces the text between the marks NAME in docs/boards.md by the contents of FILE.
into_boards() {
  awk -v name="$1" -v tables="$2" '
    $0 == "<!-- " name ": end -->" { skip = 0 }
    !skip { print }
    $0 == "<!-- " name ": begin -->" { skip = 1; while ((getline line < tables) > 0) print line }
  ' docs/boards.md >"$LOGS/boards.md" && cp "$LOGS/boards.md" docs/boards.md
}

build_counter() {
  mkdir -p "$LOGS"
  step plugin "building the emulator's counter" \
    cc -O2 -Wall -Wextra -shared -fPIC -o "$LOGS/count.so" toolchains/board/count_instructions.c
}

# instructions PRESET CASE KERNELS: prints the number of instructions of one refocusing on the emulated board.
instructions() {
  local runs preset=$1 name=$2 kernels=$3
  for runs in 1 2; do
    $(emulator "$preset") -d plugin \
      -plugin "$LOGS/count.so,sym=starfocus,sym=starfocus_,sym=memcpy,sym=memset,sym=memmove" \
      "build/$preset/tests/instruction_bench" "$name" "$kernels" $runs 2>&1 |
      sed -n 's/^instructions: //p'
  done | awk 'NR == 1 { first = $1 } NR == 2 { print $1 - first }'
}

# count_case NAME:PIXELS:KERNELS: writes the line "NAME KERNELS PIXELS INSTRUCTIONS" to a separate file.
count_case() {
  local name=${1%%:*} pixels=${1#*:} kernels=${1##*:}
  pixels=${pixels%:*}
  printf '%s %s %s %s\n' "$name" "$kernels" "$pixels" "$(instructions aarch64 "$name" "$kernels")" \
    >"$LOGS/count-$name-$kernels"
}

# Counts instructions per pixel with NEON and with the reference kernels. Fails if a count is more than 3 % above the
# count of the same compiler in toolchains/board/instruction_counts.txt. With `record`, writes the counts to
# toolchains/board/instruction_counts.txt and docs/boards.md.
count() {
  local baseline=toolchains/board/instruction_counts.txt now=$LOGS/instruction_counts.txt cases item
  local compiler recorded
  build_counter
  compiler=$(aarch64-linux-gnu-g++ --version | head -n 1)
  cases=$(qemu-aarch64 build/aarch64/tests/instruction_bench list | sed 's/\(.*\) \(.*\)/\1:\2:simd \1:\2:reference/')
  rm -f "$LOGS"/count-*
  side_by_side count_case $cases || fail "counting instructions failed"
  for item in $cases; do cat "$LOGS/count-${item%%:*}-${item##*:}"; done >"$now"
  if [ "${1:-}" = record ]; then
    { printf 'compiler %s\n' "$compiler" && cat "$now"; } >$baseline
    awk '
      BEGIN { print "| instructions per pixel | NEON | scalar | ratio |\n|---|--:|--:|--:|" }
      $2 == "simd" { simd = $4 }
      $2 == "reference" {
        printf "| %s | %.0f | %.0f | %.2f |\n", $1, simd / $3, $4 / $3, $4 / simd
      }' $baseline >"$LOGS/count.md"
    into_boards count "$LOGS/count.md"
  fi
  recorded=$(sed -n 's/^compiler //p' $baseline)
  awk -v judge="$([ "$recorded" = "$compiler" ] && echo 1)" '
    $1 == "compiler" { next }
    NR == FNR { expected[$1 " " $2] = $4; next }
    { count[$1 " " $2] = $4; if ($2 == "simd") { names[++n] = $1; pixels[$1] = $3 } }
    function change(key) { return (count[key] / expected[key] - 1) * 100 }
    END {
      printf "%-24s %10s %10s %7s  %s\n", "AArch64 instructions", "NEON", "scalar", "ratio",
        "against the baseline"
      for (i = 1; i <= n; ++i) {
        simd = names[i] " simd"; reference = names[i] " reference"
        if (!count[simd] || !count[reference] || !expected[simd] || !expected[reference]) {
          print names[i] ": not counted, or not in the baseline"; bad = 1; continue
        }
        printf "%-24s %10.1f %10.1f %7.2f  %+.2f %% %+.2f %%\n", names[i],
          count[simd] / pixels[names[i]], count[reference] / pixels[names[i]],
          count[reference] / count[simd], change(simd), change(reference)
        if (judge && (change(simd) > 3 || change(reference) > 3)) bad = 1
      }
      if (n == 0) bad = 1
      exit bad
    }' $baseline "$now" ||
    fail "more instructions than $baseline says; if that is meant: ./do count record"
  [ "$recorded" = "$compiler" ] ||
    echo "SKIPPED the comparison: $baseline is of $recorded, this is $compiler"
}

# count_command [record]: prepares the emulated board and counts instructions.
count_command() {
  case "${1:-}" in '' | record) ;; *) fail "usage: ./do count [record]" ;; esac
  prepare_board aarch64
  cross_build aarch64 starfocus_instruction_bench
  count "${1:-}"
}

# prepare_board PRESET: installs the compiler and the emulator, and makes the sysroot.
prepare_board() {
  local PACKAGES="g++ cmake ninja-build pkg-config qemu-user" board_compiler board_sysroot
  board "$1"
  PACKAGES="$PACKAGES $board_compiler"
  install_missing
  step "sysroot-$1" "fetching headers and libraries for $1" \
    toolchains/sysroot.sh $board_sysroot build/sysroot/$board_sysroot
}

# byte_tests PRESET: runs the byte tests. For aarch64, also builds the kernel tests with SVE at the same time, because one
# source file takes most of the time of this build.
byte_tests() {
  local build= result=0
  if [ "$1" = aarch64 ]; then
    cross_build aarch64-max starfocus_simd_byte_tests &
    build=$!
  fi
  ctest --preset "$1" --parallel "$(nproc)" -L '^bytes$' || result=1
  [ -z "$build" ] || wait "$build" || result=1
  return $result
}

# cross ARCHITECTURE [build|bytes]: builds everything for a board and runs all tests on an emulated board. With `bytes`,
# cross runs only the tests with the label bytes, which compare all output bytes.
cross() {
  local PACKAGES="g++ cmake ninja-build pkg-config" preset=${1:-} board_compiler board_sysroot
  case "${2:-}" in '' | build | bytes) ;; *) fail "usage: ./do cross ARCH [build|bytes]" ;; esac
  board "$preset"
  PACKAGES="$PACKAGES $board_compiler"
  [ "${2:-}" = build ] || PACKAGES="$PACKAGES qemu-user"
  install_missing
  step "sysroot-$preset" "fetching headers and libraries for $preset" \
    toolchains/sysroot.sh $board_sysroot build/sysroot/$board_sysroot
  if [ "${2:-}" = bytes ]; then
    cross_build "$preset" starfocus_byte_tests
    byte_tests "$preset" || exit 1
  else
    cross_build "$preset"
    [ "${2:-}" = build ] && return
    ctest --preset "$preset" --parallel "$(nproc)" || exit 1
  fi
  if [ "$preset" = aarch64 ]; then
    by_sve_length
    cross_build aarch64 starfocus_instruction_bench
    count
  fi
}

# Updates the checksums in tests/engine/golden.txt after an intended change of the engine's output.
golden() {
  install_missing
  build starfocus_engine_byte_tests
  STARFOCUS_RECORD_GOLDEN=1 $BUILD/tests/engine_byte_tests --no-intro=true '--source-file=*/golden_bytes_test.cc'
}

# code_bytes TRIPLE LIBRARY: prints the bytes of code and read-only data of a program that calls all functions for
# refocusing, after the linker removed unused sections.
code_bytes() {
  local object=build/log/collected.o
  "$1-ld" -r --gc-sections -e starfocus_refocus -u starfocus_workspace_size -u starfocus_init -u starfocus_stream_begin \
    -u starfocus_stream_push -u starfocus_stream_pull -u starfocus_status_string -o $object "$2" || exit 1
  "$1-size" -A $object |
    awk '/^\.text/ { code += $2 } /^\.(rodata|data)/ { data += $2 } END { printf "%d | %d", code, data }'
}

# size_rows PRESET TRIPLE EMULATOR NAME: prints a board's rows of the table of code sizes and stack.
size_rows() {
  local type
  for type in Release MinSizeRel; do
    cmake --preset "$1" -B "build/$1-$type" -DCMAKE_BUILD_TYPE=$type &&
      cmake --build "build/$1-$type" --parallel "$(nproc)" || exit 1
  done >"$LOGS/$1.log" 2>&1
  for type in Release MinSizeRel; do
    printf '| %s, %s | %s | %s |\n' "$4" $type \
      "$(code_bytes "$2" "build/$1-$type/lib/libstarfocus.a")" \
      "$("$3" "build/$1-$type/size_probe" stack)"
  done
}

size_tables() {
  printf '| bytes | code | read-only data | stack |\n|---|--:|--:|--:|\n'
  size_rows embedded-aarch64 aarch64-linux-gnu qemu-aarch64 '64-bit ARM'
  size_rows embedded-armhf arm-linux-gnueabihf qemu-arm '32-bit ARM'
  printf '\nWorkspace in KiB on 64-bit ARM (on 32-bit ARM %s):\n\n' "$(workspace_difference)"
  qemu-aarch64 build/embedded-aarch64-Release/size_probe workspace
  printf '\nSizes of the parts of some of these workspaces, in KiB:\n\n'
  qemu-aarch64 build/embedded-aarch64-Release/size_probe parts
}

# Prints how much smaller a workspace is, at most, on 32-bit ARM than on 64-bit ARM.
workspace_difference() {
  qemu-aarch64 build/embedded-aarch64-Release/size_probe workspace >$LOGS/workspace-64
  qemu-arm build/embedded-armhf-Release/size_probe workspace >$LOGS/workspace-32
  paste -d '|' $LOGS/workspace-64 $LOGS/workspace-32 | awk -F '|' '
    NR > 2 {
      half = NF / 2
      for (i = 4; i <= half; ++i) {
        less = $i - $(i + half)
        if (less > most) most = less
      }
    }
    END { printf "at most %d KiB less", most }'
}

# size [write]: prints sizes of code, stack and memory, or writes them to docs/boards.md.
size() {
  local PACKAGES="cmake ninja-build pkg-config qemu-user g++-aarch64-linux-gnu g++-arm-linux-gnueabihf"
  install_missing
  mkdir -p "$LOGS"
  local architecture
  for architecture in arm64 armhf; do
    step "sysroot-$architecture" "fetching headers and libraries for $architecture" \
      toolchains/sysroot.sh $architecture build/sysroot/$architecture
  done
  size_tables >"$LOGS/size.md" || exit 1
  if [ "${1:-}" = write ]; then
    into_boards size "$LOGS/size.md"
  else
    cat "$LOGS/size.md"
  fi
}

# boot: runs the board program on an emulated board with a Linux kernel.
boot() {
  local PACKAGES="$PACKAGES g++-aarch64-linux-gnu qemu-system-arm cpio"
  find_missing
  case " $missing " in
    *" qemu-system-arm "*)
      if [ -z "$(apt-cache policy qemu-system-arm 2>/dev/null | grep 'Candidate: [^(]')" ]; then
        echo "SKIPPED: the boot test needs the package qemu-system-arm, which cannot be installed here"
        return
      fi
      ;;
  esac
  install_missing
  step sysroot-aarch64 "fetching headers and libraries for aarch64" \
    toolchains/sysroot.sh arm64 build/sysroot/arm64
  cross_build aarch64 starfocus_board_refocus
  build starfocus starfocus_lab
  toolchains/board/boot.sh $PROGRAM build/aarch64/board_refocus build/boot || exit 1
}

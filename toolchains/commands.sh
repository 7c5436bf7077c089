# The commands of ./do that build for boards; sourced by it.

# board ARCHITECTURE: the compiler's Debian package, the emulator and the sysroot of a preset.
board() {
  case "$1" in
    aarch64) board_compiler=g++-aarch64-linux-gnu board_sysroot=arm64 ;;
    armhf) board_compiler=g++-arm-linux-gnueabihf board_sysroot=armhf ;;
    armv6) board_compiler=g++-arm-linux-gnueabi board_sysroot=armel ;;
    riscv64) board_compiler=g++-riscv64-linux-gnu board_sysroot=headers ;;
    *) fail "usage: ./do cross aarch64|armhf|armv6|riscv64 [build]" ;;
  esac
}

# cross_build PRESET [TARGET...]
cross_build() {
  local preset=$1
  shift
  step "configure-$preset" "configuring build/$preset" cmake --preset "$preset"
  step "build-$preset" "building ${*:-everything} in build/$preset" \
    cmake --build --preset "$preset" --parallel "$(nproc)" ${1:+--target "$@"}
}

# Whatever SIMD targets and vector lengths the emulator has must give the tracked checksums.
golden_by_sve_length() {
  cross_build aarch64-max golden_test
  local bytes
  for bytes in 16 32 64; do
    printf 'SVE registers of %d bytes:\n' $bytes
    qemu-aarch64 -cpu max,sve-default-vector-length=$bytes -L /usr/aarch64-linux-gnu \
      -E LD_LIBRARY_PATH=build/sysroot/arm64/usr/lib/aarch64-linux-gnu \
      build/aarch64-max/tests/golden_test --no-intro=true >"$LOGS/golden-$bytes.log" 2>&1 ||
      fail "checksums differ with SVE registers of $bytes bytes: see $LOGS/golden-$bytes.log"
    grep '^golden:' "$LOGS/golden-$bytes.log"
  done
}

# cross ARCHITECTURE [build]: builds everything for a board and runs every test on an emulated one.
cross() {
  local PACKAGES="cmake ninja-build pkg-config" preset=${1:-} board_compiler board_sysroot
  board "$preset"
  PACKAGES="$PACKAGES $board_compiler"
  [ "${2:-}" = build ] || PACKAGES="$PACKAGES qemu-user"
  install_missing
  step "sysroot-$preset" "fetching headers and libraries for $preset" \
    toolchains/sysroot.sh $board_sysroot build/sysroot/$board_sysroot
  cross_build "$preset"
  [ "${2:-}" = build ] && return
  ctest --preset "$preset" --parallel "$(nproc)" || exit 1
  [ "$preset" != aarch64 ] || golden_by_sve_length
}

# Records the checksums of tests/golden.txt anew, after an intended change of the engine's output.
golden() {
  install_missing
  build golden_test
  STARFOCUS_RECORD_GOLDEN=1 $BUILD/tests/golden_test --no-intro=true
}

# code_bytes TRIPLE LIBRARY: bytes of code and of read-only data that a program which calls
# everything the engine offers for refocusing keeps after its linker's garbage collection.
code_bytes() {
  local object=build/log/collected.o
  "$1-ld" -r --gc-sections -e sf_refocus -u sf_workspace_size -u sf_init -u sf_stream_begin \
    -u sf_stream_push -u sf_stream_pull -u sf_status_string -o $object "$2" || exit 1
  "$1-size" -A $object |
    awk '/^\.text/ { code += $2 } /^\.(rodata|data)/ { data += $2 } END { printf "%d | %d", code, data }'
}

# size_rows PRESET TRIPLE EMULATOR NAME
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
}

# How far the workspaces of the two architectures lie apart.
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

# size [write]
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
    awk -v tables="$LOGS/size.md" '
      /<!-- size: end -->/ { skip = 0 }
      !skip { print }
      /<!-- size: begin -->/ { skip = 1; while ((getline line < tables) > 0) print line }
    ' toolchains/README.md >"$LOGS/README.md" && cp "$LOGS/README.md" toolchains/README.md
  else
    cat "$LOGS/size.md"
  fi
}
